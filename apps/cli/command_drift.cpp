// SPDX-License-Identifier: MIT
// Is the camera drifting, and does a gain survive when its drift is taken out?
#include <fmt/format.h>

#include "commands.h"
#include "judged.h"
#include "verdigris/evaluate/near_copy.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/results/results.h"

namespace verdigris::cli {
namespace {

struct Arguments {
    JudgeArguments judge;
    std::string forecasters = "affinergb";
};

void run(Session& session, const Arguments& a) {
    check_results_folder(a.judge.output, kDriftFile, session.force);
    const std::vector<Entrant> entrants = entrants_from(a.forecasters);
    if (const auto learned = checkpoints_among(a.forecasters); !learned.empty())
        throw Error(ErrorCode::usage,
                    "a network is judged by `evaluate` only: `drift` holds nothing out",
                    learned.front());
    if (entrants.empty())
        throw Error(ErrorCode::usage,
                    "persistence gains nothing over itself; name another forecaster");
    const std::vector<Observation> observations = observe_all(session, a.judge);
    EvaluationProtocol protocol = protocol_for(session, a.judge, observations);
    protocol.single = true;  // nothing is trained, and each recording has a light of its own
    std::vector<SurfacePrint> surfaces;
    for (const Observation& o : observations)
        surfaces.push_back(surface_print(o, {0, o.store->count()}));
    for (std::size_t i = 0; i < observations.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (observations[i].source_sha256 == observations[k].source_sha256)
                throw Error(ErrorCode::refused,
                            fmt::format("{} and {} are two copies of one recording: one piece of "
                                        "evidence would look like two",
                                        observations[k].source_name, observations[i].source_name));
            const double likeness = surface_likeness(surfaces[k], surfaces[i]);
            if (likeness >= kNearCopy)
                throw Error(ErrorCode::refused,
                            near_copy_sentence(observations[k].source_name,
                                               observations[i].source_name, likeness) +
                                ", so that one piece of evidence would look like two");
        }
    }
    std::vector<RecordingDrift> list;
    for (const Observation& o : observations)
        list.push_back(measure_recording_drift(protocol, o, entrants, {}, session.progress()));
    Report report = drift_report(protocol, list);
    report.footer = fmt::format("verdigris {}", VERDIGRIS_VERSION);
    const Json json = json_of(protocol, list);
    deliver_results(session, a.judge.output, report,
                    {drift_windows(list), drift_series_table(list)},
                    [&](const std::filesystem::path& folder) {
                        write_file(folder / kDriftFile, json.dump(2) + "\n");
                        write_file(folder / kProtocolFile, protocol_text(protocol));
                        write_csv(folder / kDriftMapsFile, table_csv(drift_map_table(list)));
                    });
    session.say("");
    session.say(table_plain(drift_gain_table(list)));
    for (const RecordingDrift& d : list) {
        for (const std::string& sentence : d.sentences) session.say(sentence);
        for (const Status& s : d.notes) session.tell(s);
    }
    tell_recordings(session, observations);
    session.result(json);
}

}  // namespace

void add_drift(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "drift", "Is the camera drifting, and does a gain survive when that is taken out?");
    a->judge.add(*command, true);
    command
        ->add_option("--forecasters", a->forecasters, "Names with commas between, as in evaluate")
        ->capture_default_str();
    command->add_flag("--force", session.force, "Write into a folder with other files");
    session.add_options(*command);
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
