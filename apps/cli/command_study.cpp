// SPDX-License-Identifier: MIT
// Studies over simulated specimens: why does a network not transfer?
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "judged.h"
#include "learned_commands.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/study/transfer_report.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTransferFile = "transfer.json";

struct Arguments {
    std::string output, runs, networks, presets;
    std::optional<int> seeds, epochs, size;
    bool quick = false;
};

std::vector<std::string> parts_of(const std::string& names) {
    std::vector<std::string> parts;
    for (std::size_t start = 0; start <= names.size();) {
        const std::size_t end = std::min(names.find(',', start), names.size());
        parts.push_back(names.substr(start, end - start));
        start = end + 1;
    }
    return parts;
}

void run_transfer(Session& session, const Arguments& a) {
    check_results_folder(a.output, kTransferFile, session.force);
    TransferStudyOptions options = a.quick ? quick_transfer_study() : TransferStudyOptions();
    if (a.seeds) options.seeds = *a.seeds;
    if (a.epochs) options.epochs = *a.epochs;
    if (a.size) options.size = *a.size;
    if (!a.networks.empty()) {
        options.networks.clear();
        for (const std::string& name : parts_of(a.networks))
            options.networks.push_back(network_kind(name));
    }
    if (!a.presets.empty()) options.presets = parts_of(a.presets);
    options.threads = session.threads;
    check_transfer_options(options);
    // Beside the results and not in them: trainings are kept from run to run.
    fs::path folder = fs::path(a.output);
    if (!folder.has_filename()) folder = folder.parent_path();
    const fs::path runs = a.runs.empty() ? fs::path(folder.string() + "-runs") : fs::path(a.runs);
    session.say(fmt::format("trainings are kept in {}; interrupted, the study goes on from there",
                            runs.string()));
    const TransferStudy study = run_transfer_study(options, runs, session.progress());
    Report report = transfer_report(study);
    report.footer = fmt::format("verdigris {}", VERDIGRIS_VERSION);
    const Json json = json_of(study);
    deliver_results(
        session, a.output, report, {transfer_scores(study)},
        [&](const fs::path& staged) { write_file(staged / kTransferFile, json.dump(2) + "\n"); });
    session.say("");
    session.say(table_plain(transfer_cell_table(study)));
    session.say(table_plain(transfer_effect_table(study)));
    session.say(table_plain(specimen_count_table(study)));
    for (const std::string& s : transfer_sentences(study)) session.say(s);
    session.result(json);
}

}  // namespace

void add_study(CLI::App& app, Session& session) {
    CLI::App* study = app.add_subcommand("study", "Studies over simulated specimens");
    study->require_subcommand(1);
    auto a = std::make_shared<Arguments>();
    CLI::App* command = study->add_subcommand(
        "transfer",
        "Why does a network not transfer: the pattern, the pose, the camera or the kinetics? And "
        "do more "
        "specimens help?");
    command->add_option("-o,--out", a->output, "Result folder")->required();
    command->add_option("--runs", a->runs, "Where trainings are kept (OUT-runs)");
    command->add_flag("--quick", a->quick,
                      "Two seeds, one network, 32 pixels: minutes, no evidence");
    command->add_option("--networks", a->networks,
                        "Names with commas between (patinanet,horizonnet)");
    command->add_option("--presets", a->presets, "Kinds of specimen, with commas (chamber,air)");
    command->add_option("--seeds", a->seeds, "Source specimens per preset (3)");
    command->add_option("--epochs", a->epochs, "Of each training (6)");
    command->add_option("--size", a->size, "Side of the samples (64)");
    command->add_flag("--force", session.force, "Write into a folder with other files");
    session.add_options(*command);
    command->get_option("--threads")
        ->description("Threads to use (0: all). Another number, other last bits");
    command->callback([a, &session] { session.action = [a](Session& s) { run_transfer(s, *a); }; });
}

}  // namespace verdigris::cli
