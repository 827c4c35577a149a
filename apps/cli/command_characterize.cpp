// SPDX-License-Identifier: MIT
// What the closed-form forecaster needs, and how far it can be followed.
#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "judged.h"
#include "verdigris/evaluate/characterize.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/results/results.h"

namespace verdigris::cli {
namespace {

// Contexts for which the shortest recording has no window are left out, and said so; the protocol's
// own is kept, so that a recording too short for it is refused with its sentence.
std::vector<int> contexts_that_fit(Session& session, const EvaluationProtocol& protocol,
                                   const std::vector<Observation>& observations,
                                   const std::vector<int>& wanted) {
    const auto fits = [&](int n) {
        EvaluationProtocol p = protocol;
        p.context = n;
        return std::ranges::all_of(observations, [&](const Observation& o) {
            return o.store->count() - p.trim_lead - p.trim_tail > p.span();
        });
    };
    std::vector<int> fit;
    for (const int n : wanted) {
        if (fits(n) || n == protocol.context) {
            fit.push_back(n);
        } else if (fits(protocol.context)) {
            session.tell({"context_left_out", Severity::caution,
                          fmt::format("a context of {} frames is left out: the recordings are too "
                                      "short for one window of it",
                                      n)});
        }
    }
    if (std::ranges::count(fit, protocol.context) == 0) fit.push_back(protocol.context);
    return fit;
}

void run(Session& session, const JudgeArguments& a) {
    check_results_folder(a.output, kCharacterizationFile, session.force);
    const std::vector<Observation> observations = observe_all(session, a);
    EvaluationProtocol protocol = protocol_for(session, a, observations);
    CharacterizeOptions options;
    // The paper's sweep, unless something else was asked for.
    options.windows =
        a.windows.value_or(a.protocol.empty() ? options.windows : protocol.max_windows);
    protocol.max_windows = options.windows;
    options.contexts = contexts_that_fit(session, protocol, observations, options.contexts);
    const Characterization table =
        characterize(protocol, observations, options, session.progress());
    EvaluationProtocol quick = protocol;
    quick.delta_e = quick.hash_frames = false;  // neither is shown; frames were compared above
    const int horizon = 85;                     // [Paper], Section 7
    const Evaluation far = long_horizons(quick, observations, horizon, {}, session.progress());
    const CharacterizationVerdict verdict = characterization_verdict(protocol, table, far);
    Report report = characterization_report(protocol, table, verdict);
    report.footer = fmt::format("verdigris {}", VERDIGRIS_VERSION);
    const Json json = json_of(protocol, table, verdict);
    Table long_windows = window_errors(far);
    long_windows.id = "windows_long";
    deliver_results(session, a.output, report, {characterization_windows(table), long_windows},
                    [&](const std::filesystem::path& folder) {
                        write_file(folder / kCharacterizationFile, json.dump(2) + "\n");
                        write_file(folder / kProtocolFile, protocol_text(protocol));
                    });
    session.say("");
    session.say(table_plain(characterization_table(table, verdict)));
    for (const std::string& sentence : verdict.sentences) session.say(sentence);
    for (const Status& s : table.notes) session.tell(s);
    tell_recordings(session, observations);
    session.result(json);
}

}  // namespace

void add_characterize(CLI::App& app, Session& session) {
    auto a = std::make_shared<JudgeArguments>();
    CLI::App* command = app.add_subcommand(
        "characterize", "What the closed-form forecaster needs, and how far it can be followed");
    a->add(*command, true);
    command->add_flag("--force", session.force, "Write into a folder with other files");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
