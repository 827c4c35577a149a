// SPDX-License-Identifier: MIT
// Forecasters against doing nothing, on recordings that nothing was learned from.
#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "judged.h"
#include "learned.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/results/results.h"

namespace verdigris::cli {
namespace {

struct Arguments {
    JudgeArguments judge;
    std::string forecasters = "persistence,affinergb,auto", blocks;
};

void run(Session& session, const Arguments& a) {
    check_results_folder(a.judge.output, kEvaluationFile, session.force);
    std::vector<Entrant> entrants = entrants_from(a.forecasters);
    const std::vector<std::string> checkpoints = checkpoints_among(a.forecasters);
    check_checkpoints(checkpoints);
    const std::vector<NamedBlock> blocks =
        a.blocks.empty() ? std::vector<NamedBlock>() : read_blocks(a.blocks);
    const std::vector<Observation> observations = observe_all(session, a.judge);
    const EvaluationProtocol protocol = protocol_for(session, a.judge, observations);
    for (Entrant& learned : learned_entrants(checkpoints, protocol))
        entrants.push_back(std::move(learned));
    const Evaluation evaluation = evaluate(protocol, observations, entrants, session.progress());
    // As `characterize`: a result without a number is none.
    const bool any_scored = std::ranges::any_of(
        evaluation.directions, [](const Direction& d) { return !d.starts.empty(); });
    if (!any_scored) {
        const Direction& d = evaluation.directions.front();
        throw Error(ErrorCode::refused,
                    fmt::format("leaves no window to score, and no other recording does: {}",
                                d.skipped.empty() ? "none fits" : d.skipped.front().why),
                    d.held_out);
    }
    const std::vector<DirectionVerdict> list = verdicts(evaluation, blocks);
    Report report = evaluation_report(evaluation, list);
    report.footer = fmt::format("verdigris {}", VERDIGRIS_VERSION);
    const Json json = json_of(evaluation, list);
    deliver_results(session, a.judge.output, report, {window_errors(evaluation)},
                    [&](const std::filesystem::path& folder) {
                        write_file(folder / kEvaluationFile, json.dump(2) + "\n");
                        write_file(folder / kRecordFile, json_of(evaluation.record).dump() + "\n");
                        write_file(folder / kProtocolFile, protocol_text(protocol));
                    });
    session.say("");
    session.say(table_plain(error_table(evaluation)));
    for (const std::string& sentence : verdict_sentences(list)) session.say(sentence);
    for (const Status& s : evaluation.notes) session.tell(s);
    tell_recordings(session, observations);
    session.result(json);
}

}  // namespace

void add_evaluate(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "evaluate", "Judge forecasters against doing nothing, on recordings held out");
    a->judge.add(*command, true);
    command
        ->add_option("--forecasters", a->forecasters,
                     "Names with commas between: auto, affinergb, affinergb-per-channel-1 ... (the "
                     "paper's, unregularized); affinergb-ridge, as `age` has it; checkpoints that "
                     "`train` made, RUN/best.safetensors")
        ->capture_default_str();
    command->add_option("--hold-out", a->judge.hold_out,
                        "Hold out this recording only (its name in the results): for checkpoints "
                        "that learned from the others");
    command
        ->add_option("--blocks", a->blocks,
                     "TOML with spans of each recording to report gains of: [recording] and "
                     "lines name = [begin, end] in units")
        ->check(CLI::ExistingFile);
    command->add_flag("--force", session.force, "Write into a folder with other files");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
