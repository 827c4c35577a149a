// SPDX-License-Identifier: MIT
// Does what a network believes of a surface hold on another surface? The paper's Figure 5.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "judged.h"
#include "learned_commands.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/png.h"
#include "verdigris/learn/susceptibility_report.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/results/protocol_file.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSusceptibilityFile = "susceptibility.json";

struct Arguments {
    JudgeArguments judge;
    std::string run;
};

void run(Session& session, const Arguments& a) {
    check_results_folder(a.judge.output, kSusceptibilityFile, session.force);
    std::error_code error;
    const fs::path given = a.run;
    const fs::path path = fs::is_directory(given, error) ? given / kBestFile : given;
    const Checkpoint checkpoint = read_checkpoint(path);
    const std::vector<Observation> observations = observe_all(session, a.judge);
    EvaluationProtocol protocol = protocol_for(session, a.judge, observations);
    const SusceptibilityAnalysis analysis =
        analyze_susceptibility(checkpoint, protocol, observations, session.progress());
    Report report = susceptibility_report(checkpoint, analysis);
    report.footer = fmt::format("verdigris {}", VERDIGRIS_VERSION);
    const Json json = json_of(analysis);
    deliver_results(session, a.judge.output, report, {}, [&](const fs::path& folder) {
        write_file(folder / kSusceptibilityFile, json.dump(2) + "\n");
        write_file(folder / kProtocolFile, protocol_text(protocol));
        write_png(folder / "maps.png", susceptibility_sheet(analysis));
    });
    session.say("");
    session.say(table_plain(susceptibility_table(analysis)));
    for (const std::string& s : susceptibility_sentences(analysis)) session.say(s);
    session.result(json);
}

}  // namespace

void add_susceptibility(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "susceptibility",
        "What a trained patinanet believes of surfaces, and whether it transfers");
    command->add_option("RUN", a->run, "A folder that `train` made, or a checkpoint")->required();
    a->judge.add(*command, true);
    command->get_option("RECORDING")->description("Videos, or folders of photographs");
    command->add_flag("--force", session.force, "Write into a folder with other files");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
