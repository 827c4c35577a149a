// SPDX-License-Identifier: MIT
#include "verdigris/reproduce/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

namespace verdigris {
namespace fs = std::filesystem;
namespace {

/// Sizes of the two settings.
struct Setting {
    std::vector<std::string> simulate, judge, few_windows, network, training, materials;
    double shorter = 1;  ///< factor on costs
};

Setting setting_of(bool quick) {
    if (!quick) return {};
    // 300 frames are three samples per unit: everything is as short as it can be and still be
    // judged.
    return {.simulate = {"--size", "320x180", "--frames", "300"},
            .judge = {"--windows", "40"},
            .few_windows = {"--windows", "12"},
            .network = {"--size", "64"},
            .training = {"--epochs", "1", "--train-windows", "8"},
            .materials = {"--windows", "2", "--size", "64", "--picture", "64", "--samples", "16"},
            .shorter = 0.25};
}

class Planner {
  public:
    explicit Planner(const ReproductionOptions& options)
        : options_(options), setting_(setting_of(options.quick)) {}

    std::vector<Task> tasks() {
        for (int i = 0; i < 2; ++i) {
            recordings_.push_back(reproduced_recording(options_, i));
            if (options_.recordings.empty()) simulate(i);
        }
        judge("evaluate", "evaluate", "forecasters held out (Table 1, Figure 3)",
              {"--forecasters", "affinergb,affinergb-ridge,backtest,auto"}, setting_.judge, 100);
        judge("characterize", "characterize", "what the closed form needs (Table 2)", {},
              setting_.few_windows, options_.quick ? 20 : 38);
        judge("drift", "drift", "the camera's drift (Figure 4)", {}, setting_.judge, 25);
        for (const std::string& network : trained_networks(options_)) networks(network);
        for (int i = 0; i < 2; ++i) susceptibility(i);
        materials();
        if (!options_.copper.empty()) copper();
        audit("evaluate");
        for (const std::string& network : trained_networks(options_))
            audit("evaluate-" + network, options_.no_networks);
        return std::move(tasks_);
    }

  private:
    Task& add(const std::string& id, const std::string& title,
              const std::vector<std::vector<std::string>>& arguments,
              const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs,
              double cost) {
        Task task;
        task.id = id;
        task.title = title;
        for (const auto& part : arguments)
            task.arguments.insert(task.arguments.end(), part.begin(), part.end());
        task.kind = task.arguments.front();
        task.inputs = inputs;
        task.outputs = outputs;
        task.cost = cost * setting_.shorter;
        tasks_.push_back(std::move(task));
        return tasks_.back();
    }

    std::vector<std::string> both() const {
        return {recordings_[0].string(), recordings_[1].string()};
    }

    void simulate(int i) {
        const char* preset = i == 0 ? "chamber" : "air";
        add(fmt::format("simulate-{}", preset), fmt::format("simulate {}", preset),
            {{"simulate", "--preset", preset, "--seed", "1"},
             setting_.simulate,
             {"-o", recordings_[std::size_t(i)].string()}},
            {}, {recordings_[std::size_t(i)], fmt::format("recordings/{}.spec.toml", preset)}, 14);
    }

    void judge(const std::string& id, const std::string& command, const std::string& title,
               const std::vector<std::string>& more, const std::vector<std::string>& windows,
               double cost) {
        add(id, title, {{command}, both(), {"-o", id}, more, windows}, recordings_, {id}, cost);
    }

    void networks(const std::string& network) {
        // CPU seconds of 12 epochs of 88 steps and their validation; of judging 2 x 810 windows.
        struct Cost {
            double train, evaluate;
        };
        static const std::map<std::string, Cost> kCosts{{"patinanet", {1950, 600}},
                                                        {"convlstm", {3950, 500}},
                                                        {"predformer", {2000, 330}},
                                                        {"horizonnet", {3500, 1040}}};
        std::vector<fs::path> inputs = recordings_;
        std::vector<std::string> checkpoints;
        for (int i = 0; i < 2; ++i) {
            const fs::path run = trained_run(network, i);
            const fs::path& source = recordings_[std::size_t(i)];
            Task& task =
                add("train-" + run.filename().string(),
                    fmt::format("train {} on {}", network, source.stem().string()),
                    {{"train", network, "--source", source.string(), "-o", run.string()},
                     setting_.network,
                     setting_.training},
                    {source}, {run}, kCosts.at(network).train * (options_.quick ? 0.008 : 1));
            task.resume_mark = run / "last.safetensors";
            task.resume_option = "--resume";
            // One thread: four networks side by side finish sooner, and the last bits depend on it.
            task.most_threads = 1;
            task.missing = options_.no_networks;
            checkpoints.push_back((run / "best.safetensors").string());
            inputs.emplace_back(checkpoints.back());
        }
        const std::string id = "evaluate-" + network;
        add(id, fmt::format("{} held out (Table 1)", network),
            {{"evaluate"},
             both(),
             {"-o", id, "--forecasters", fmt::format("{}", fmt::join(checkpoints, ","))},
             setting_.network,
             setting_.judge},
            inputs, {id}, options_.quick ? 20 : kCosts.at(network).evaluate)
            .missing = options_.no_networks;
    }

    void susceptibility(int i) {
        const fs::path run = trained_run("patinanet", i);
        const std::string id = fmt::format("susceptibility-{}", i == 0 ? "first" : "second");
        std::vector<fs::path> inputs = recordings_;
        inputs.push_back(run / "best.safetensors");
        add(id, fmt::format("what patinanet of recording {} believes (Figure 5)", i + 1),
            {{"susceptibility", (run / "best.safetensors").string()},
             both(),
             {"-o", id},
             setting_.network},
            inputs, {id}, 12)
            .missing = options_.no_networks;
    }

    void materials() {
        std::vector<fs::path> inputs = recordings_;
        // A quick network is of another size than the frames, and one size is judged at a time.
        std::string forecasters = "affinergb,affinergb-clamped,affinergb-in-range,auto";
        if (options_.no_networks.empty()) {
            for (int i = 0; i < 2; ++i) {
                inputs.push_back(trained_run("patinanet", i) / "best.safetensors");
                forecasters += "," + inputs.back().string();
            }
        }
        add("materials", "materials beside the true ones (Table 3)",
            {{"judge-materials"},
             both(),
             {"-o", "materials", "--forecasters", forecasters, "--horizons",
              options_.quick ? "5,10,20" : "5,10,20,50"},
             setting_.materials},
            inputs, {"materials"}, options_.quick ? 60 : 300);
    }

    void copper() {
        const std::string input = options_.copper.string();
        const std::vector<std::string> list{"--forecasters",
                                            "affinergb,affinergb-ridge,backtest,auto"};
        // As docs/RESULTS.md judges these photographs: three samples per unit.
        add("copper", "real copper, within the recording",
            {{"evaluate", input, "--single", "--stride", "3", "-o", "copper"}, list},
            {options_.copper}, {"copper"}, 8);
        add("copper-10", "real copper, ten frames observed",
            {{"evaluate", input, "--single", "--stride", "3", "--context", "10", "-o", "copper-10"},
             list},
            {options_.copper}, {"copper-10"}, 8);
        add("copper-characterize", "real copper: what the closed form needs",
            {{"characterize", input, "--single", "--stride", "3", "-o", "copper-characterize"}},
            {options_.copper}, {"copper-characterize"}, 12);
        audit("copper");
    }

    void audit(const std::string& result, const std::string& missing = {}) {
        Task& task = add("audit-" + result, "audit of " + result, {{"audit", result, "--json"}},
                         {result}, {}, 2);
        task.kept_output = fmt::format("audits/{}.json", result);
        task.most_threads = 1;
        task.missing = missing;
    }

    const ReproductionOptions& options_;
    const Setting setting_;
    std::vector<fs::path> recordings_;
    std::vector<Task> tasks_;
};

/// For a shell to take as one word.
std::string quoted(const std::string& word) {
    const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
        return std::isalnum(c) ||
               std::string_view("-_./,=:+@%").find(char(c)) != std::string_view::npos;
    });
    if (plain) return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

}  // namespace

const std::vector<std::string>& paper_networks() {
    static const std::vector<std::string> names{"patinanet", "convlstm", "predformer",
                                                "horizonnet"};
    return names;
}

std::vector<std::string> trained_networks(const ReproductionOptions& options) {
    return options.quick ? std::vector<std::string>{paper_networks().front()} : paper_networks();
}

fs::path reproduced_recording(const ReproductionOptions& options, int which) {
    if (!options.recordings.empty()) return options.recordings[std::size_t(which)];
    return which == 0 ? "recordings/chamber.mkv" : "recordings/air.mkv";
}

fs::path trained_run(const std::string& network, int which) {
    return fs::path("networks") / fmt::format("{}-{}", network, which == 0 ? "first" : "second");
}

std::vector<Task> reproduction_tasks(const ReproductionOptions& options) {
    return Planner(options).tasks();
}

std::string command_text(const Task& task) {
    std::string text = "verdigris";
    for (const std::string& word : task.arguments) text += " " + quoted(word);
    return text;
}

}  // namespace verdigris
