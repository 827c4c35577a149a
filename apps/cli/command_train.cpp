// SPDX-License-Identifier: MIT
// A network learns how one recording goes on, to be judged on others, or to continue this one.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "judged.h"
#include "learned_commands.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/learn/train.h"
#include "verdigris/report/draw_figure.h"
#include "verdigris/results/protocol_file.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

struct Arguments {
    JudgeArguments judge;
    std::string model, device = "cpu";
    std::vector<std::string> sources;
    TrainOptions options;
    bool still = false;
};

/// Training loss, and the validation error against holding still.
Figure loss_figure(const TrainedNetwork& trained) {
    Figure figure;
    figure.id = "loss";
    figure.title = "Training";
    FigurePanel loss, validation;
    loss.title = "training loss";
    loss.x.label = validation.x.label = "epoch";
    loss.y.label = "loss (1: persistence, about)";
    validation.title = "validation, same recording";
    validation.y = {.label = "foreground MSE, share of persistence's",
                    .format = {NumberStyle::percent, 0, false}};
    FigureSeries a{"training windows", SeriesKind::line, {}}, b{"network", SeriesKind::line, {}};
    for (const EpochRecord& e : trained.epochs) {
        a.points.push_back({double(e.epoch), e.train_loss});
        b.points.push_back({double(e.epoch), e.validation_error / e.validation_persistence});
    }
    loss.series.push_back(a);
    validation.series.push_back(b);
    validation.references.push_back({"persistence", 1});
    figure.panels = {loss, validation};
    return figure;
}

/// A run goes on by the rules it began with. They are compared as files, key by key.
void check_same_rules(const fs::path& folder, const EvaluationProtocol& protocol) {
    std::error_code error;
    if (!fs::exists(folder / kProtocolFile, error)) return;
    std::istringstream before(protocol_text(read_protocol(folder / kProtocolFile))),
        now(protocol_text(protocol));
    std::vector<std::string> keys;
    for (std::string a, b; std::getline(before, a) && std::getline(now, b);) {
        // A key that is not set is a comment: "# tau =".
        const std::size_t start = b.starts_with("# ") ? 2 : 0;
        if (a != b) keys.push_back(b.substr(start, b.find(' ', start) - start));
    }
    if (keys.empty()) return;
    throw Error(ErrorCode::refused,
                fmt::format("began by other rules than are asked for ({} in its {})",
                            fmt::join(keys, ", "), kProtocolFile),
                folder.string());
}

double peak_memory_gb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) * 1024 / 1e9;
}

Json json_of(const EpochRecord& e) {
    return {{"epoch", e.epoch},
            {"train_loss", e.train_loss},
            {"validation_error", e.validation_error},
            {"step_seconds", e.step_seconds},
            {"seconds", e.seconds}};
}

void run(Session& session, Arguments a) {
    a.options.kind = network_kind(a.model);
    a.options.device = device_from(a.device);
    a.options.augment = !a.still;
    a.options.threads = session.threads;
    check_train_options(a.options);
    if (a.judge.windows || a.judge.area == "specimen") {
        throw Error(ErrorCode::usage,
                    a.judge.windows
                        ? "--windows is for judging; --train-windows limits what is learned from"
                        : "--area specimen is for judging; a network sees and learns the frame");
    }
    const fs::path folder = a.judge.output;
    if (!a.options.resume) refuse_to_begin_over(folder);
    a.judge.recordings = a.sources;
    const std::vector<Observation> observations = observe_all(session, a.judge);
    const EvaluationProtocol protocol = protocol_for(session, a.judge, observations);
    if (a.options.resume) check_same_rules(folder, protocol);
    std::vector<TrainingSource> sources;
    for (const Observation& o : observations) {
        const WindowPlan plan = plan_windows(protocol, o.store->count(), o.source_name);
        if (!plan.splits) {
            throw Error(ErrorCode::refused, "cannot be trained on: " + plan.splits_problem,
                        o.source_name);
        }
        sources.push_back({o.source_name, &o, plan.splits->train, plan.splits->validation});
    }
    session.say(fmt::format("training  {}", a.model));
    if (protocol.area == EvaluatedArea::specimen) {
        session.say("          on whole frames: the protocol's area, specimen, is for judging");
    }
    for (const TrainingSource& s : sources) {
        session.say(fmt::format(
            "          on samples {} to {} of {}; the epoch is chosen on {} "
            "to {}",
            s.train.begin, s.train.end - 1, s.name, s.validation.begin, s.validation.end - 1));
    }
    bool rules_written = false;  // with the first epoch: what is refused leaves nothing behind
    const auto told = [&](const EpochRecord& e) {
        if (!std::exchange(rules_written, true))
            write_file(folder / kProtocolFile, protocol_text(protocol));
        session.say(
            fmt::format("epoch {:>3}  loss {:.4f}  validation {:.3e} ({:+.1f} % against "
                        "persistence)  {:.0f} s",
                        e.epoch, e.train_loss, e.validation_error,
                        100 * gain_over(e.validation_error, e.validation_persistence), e.seconds));
    };
    const TrainedNetwork trained =
        train_network(protocol, sources, a.options, folder, session.progress(), told);
    const Figure figure = loss_figure(trained);
    if (gnuplot_is_installed()) {
        write_file(folder / "loss.svg", draw_figure(figure, FigureFormat::svg));
        write_file(folder / "loss.png", draw_figure(figure, FigureFormat::png));
    } else {
        session.tell({"figures_left_out", Severity::info, "there is no gnuplot to draw loss.svg"});
    }
    const TrainingFacts& f = trained.facts;
    session.say("");
    session.say(
        fmt::format("best      epoch {}: validation {:.3e}, persistence {:.3e} on the same "
                    "windows of the same recording",
                    f.epoch, f.validation_error, f.validation_persistence));
    session.say(fmt::format(
        "Judge it  verdigris evaluate {} OTHER -o RESULTS --protocol {}{}{} "
        "--forecasters {},affinergb --hold-out OTHER",
        fmt::join(a.sources, " "), (folder / kProtocolFile).string(),
        a.judge.size == 128 ? "" : fmt::format(" --size {}", a.judge.size),
        a.judge.crop == "auto" ? "" : " --crop " + a.judge.crop, (folder / kBestFile).string()));
    Json epochs = Json::array();
    for (const EpochRecord& e : trained.epochs) epochs.push_back(json_of(e));
    session.result({{"model", a.model},
                    {"parameters", trained.network->parameter_count()},
                    {"sources", a.sources},
                    {"checkpoint", (folder / kBestFile).string()},
                    {"best_epoch", f.epoch},
                    {"validation_error", f.validation_error},
                    {"validation_persistence", f.validation_persistence},
                    {"threads", f.threads},
                    {"peak_memory_gb", peak_memory_gb()},
                    {"epochs", std::move(epochs)}});
}

}  // namespace

void add_train(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("train", "Train a network on a recording (docs/models/learn.md)");
    command->add_option("MODEL", a->model, "patinanet, convlstm, predformer or horizonnet")
        ->required();
    command->add_option("--source", a->sources, "Videos or folders of photographs to learn from")
        ->required();
    a->judge.add_rules(*command);
    command->add_option("--epochs", a->options.epochs, "Times that all training windows are seen")
        ->capture_default_str();
    command->add_option("--batch", a->options.batch, "Windows per step")->capture_default_str();
    command->add_option("--seed", a->options.seed, "Of weights, order and augmentation")
        ->capture_default_str();
    command->add_option("--learning-rate", a->options.learning_rate, "At the first step")
        ->capture_default_str();
    command->add_option("--train-windows", a->options.max_windows,
                        "At most so many training windows, evenly spaced (all)");
    command->add_option("--device", a->device, "cpu or cuda")->capture_default_str();
    command->add_flag("--no-augment", a->still, "Learn from the windows as they are");
    command->add_flag("--resume", a->options.resume, "Go on with the run in the folder");
    session.add_options(*command);
    command->get_option("--threads")
        ->description("Threads to use (0: all). Another number, other last bits");
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
