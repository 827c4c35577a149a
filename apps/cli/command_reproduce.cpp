// SPDX-License-Identifier: MIT
// Every table and figure of the paper, beside the paper's own values.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <system_error>
#include <thread>

#include "commands.h"
#include "judged.h"
#include "learned.h"
#include "task_printer.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/folder_lock.h"
#include "verdigris/files/sha256.h"
#include "verdigris/recording/recording.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/reproduce/reproduce.h"
#include "verdigris/results/result_files.h"
#include "verdigris/workflow/workflow.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFormat = "verdigris-reproduction/1";
constexpr const char* kCommandsFile = "commands.json";

struct Arguments {
    std::string output, copper;
    std::vector<std::string> recordings;
    bool quick = false;
    int jobs = 0;
};

fs::path input_path(const std::string& given) {
    std::error_code error;
    if (!fs::exists(given, error))
        throw Error(ErrorCode::bad_input, "there is no such file or folder", given);
    const fs::path path = fs::absolute(given).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

/// Told here in a moment and not after an hour by the first task that needs both.
void check_two_recordings(const std::vector<fs::path>& recordings) {
    if (recordings.empty()) return;
    std::error_code error;
    const bool one = fs::equivalent(recordings[0], recordings[1], error);
    if (one || fingerprint(recordings[0]).content == fingerprint(recordings[1]).content)
        throw Error(ErrorCode::refused,
                    "is the same recording as " + recordings[0].filename().string() +
                        ": nothing would be held out",
                    recordings[1].string());
}

/// Likewise what is no recording; nothing of it is decoded yet.
void check_recordings(const ReproductionOptions& options) {
    for (const fs::path& r : options.recordings) open_recording(r);
    if (!options.copper.empty()) open_recording(options.copper);
}

ReproductionOptions options_of(const Arguments& a) {
    ReproductionOptions options;
    for (const std::string& r : a.recordings) options.recordings.push_back(input_path(r));
    if (!a.copper.empty()) options.copper = input_path(a.copper);
    options.quick = a.quick;
    options.no_networks = no_networks_because();
    return options;
}

Json settings_json(const ReproductionOptions& options) {
    Json recordings = Json::array();
    for (const fs::path& r : options.recordings) recordings.push_back(r.string());
    return {{"quick", options.quick}, {"recordings", recordings}};
}

/// Quick tasks would replace trainings of hours, and the other way around.
void check_same_settings(const fs::path& folder, const ReproductionOptions& options, bool force) {
    std::error_code error;
    const fs::path mark = folder / kReproductionFile;
    if (!fs::is_regular_file(mark, error) || force) return;
    const Json before = Json::parse(read_text(mark), nullptr, false);
    const Json now = settings_json(options);
    const auto same_kind = [&](const char* key) {
        return before["settings"].contains(key) &&
               before["settings"][key].type() == now[key].type();
    };
    if (!before.is_object() || !before.contains("settings") || !same_kind("quick") ||
        !same_kind("recordings"))
        throw Error(ErrorCode::bad_input, "is not what `reproduce` writes", mark.string());
    if (before["settings"] == now) return;
    const bool quick = before["settings"]["quick"];
    throw Error(ErrorCode::refused,
                fmt::format("was begun {}; choose another folder, or use --force to do again what "
                            "differs",
                            quick != options.quick ? quick ? "with --quick" : "without --quick"
                                                   : "with other recordings"),
                folder.string());
}

/// A report that was being moved into place when the run was killed may be of two runs.
void remove_half_a_report(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder / "tasks" / "report.begun", error)) return;
    for (const char* name : {kFileList, "report.html", "tables", "figures", kCommandsFile})
        fs::remove_all(folder / name, error);
}

int cores_of(const Arguments& a) {
    return a.jobs > 0 ? a.jobs : std::max(1, int(std::thread::hardware_concurrency()));
}

void talk(const Session& session, const std::string& line) {
    if (!session.quiet) std::fprintf(stderr, "%s\n", line.c_str());
}

void tell_estimate(const Session& session, const TaskGraph& graph, const WorkflowOptions& options) {
    const WorkflowEstimate estimate = estimate_tasks(graph, options);
    if (estimate.tasks == 0) {
        talk(session, "every task seems to be done; making sure");
        return;
    }
    talk(session,
         fmt::format("{} tasks of {} are to be done; on {} core{} by itself that takes about {}",
                     estimate.tasks, graph.tasks().size(), options.cores,
                     options.cores == 1 ? "" : "s", clock_text(estimate.seconds)));
}

void tell_outcomes(Session& session, const std::vector<TaskOutcome>& outcomes) {
    const auto count = [&](TaskState state) {
        return std::ranges::count(outcomes, state, &TaskOutcome::state);
    };
    session.say(
        fmt::format("Tasks     {} done, {} up to date, {} failed, {} skipped, {} not in "
                    "this build",
                    count(TaskState::done), count(TaskState::up_to_date), count(TaskState::failed),
                    count(TaskState::skipped), count(TaskState::missing)));
    const auto others = std::ranges::count(outcomes, true, &TaskOutcome::other_build);
    if (others > 0)
        session.tell({"other_build", Severity::caution,
                      fmt::format("{} of the tasks that are up to date were done by another build "
                                  "of this version; delete their records in tasks/ and what they "
                                  "made to do them again",
                                  others)});
}

void run(Session& session, const Arguments& a) {
    const ReproductionOptions options = options_of(a);
    check_recordings(options);
    check_two_recordings(options.recordings);
    const fs::path folder = fs::absolute(a.output).lexically_normal();
    const TaskGraph graph(reproduction_tasks(options));
    std::error_code error;
    const bool ours = fs::is_regular_file(folder / kReproductionFile, error);
    if (!ours) check_results_folder(folder, kReproductionFile, session.force);
    check_same_settings(folder, options, session.force);
    const FolderLock lock(folder, "worked on");
    if (ours) remove_half_a_report(folder);
    check_results_folder(folder, kReproductionFile, session.force);
    const Json settings = {
        {"format", kFormat}, {"version", VERDIGRIS_VERSION}, {"settings", settings_json(options)}};
    // The first thing there: from now on the folder is known as ours.
    write_file(folder / kReproductionFile, settings.dump(2) + "\n");

    WorkflowOptions workflow;
    // Not the path it resolves to: a build that replaces the file while tasks run would do the rest
    // of them under the name of this one.
    workflow.program = "/proc/self/exe";
    workflow.folder = folder;
    workflow.version = VERDIGRIS_VERSION;
    workflow.build = sha256_of_file(workflow.program);
    workflow.cores = cores_of(a);
    tell_estimate(session, graph, workflow);
    if (!options.no_networks.empty())
        talk(session, "networks are left out: " + options.no_networks);
    TaskPrinter printer(session.quiet);
    const std::vector<TaskOutcome> outcomes =
        run_tasks(graph, workflow, [&](const WorkflowView& view) { return printer(view); });
    printer.clear();

    const Reproduced reproduced{options, folder, graph, outcomes};
    Report report = reproduction_report(reproduced);
    report.footer = fmt::format("verdigris {}", VERDIGRIS_VERSION);
    const Json json = json_of(reproduced);
    write_file(folder / "tasks" / "report.begun", "");
    deliver_results(session, folder, report, {}, [&](const fs::path& staged) {
        write_file(staged / kCommandsFile, json.dump(2) + "\n");
    });
    fs::remove(folder / "tasks" / "report.begun", error);
    tell_outcomes(session, outcomes);
    session.result(json);
    std::vector<std::string> failed;
    for (std::size_t i = 0; i < outcomes.size(); ++i)
        if (outcomes[i].state == TaskState::failed) failed.push_back(graph.tasks()[i].id);
    if (!failed.empty()) {
        session.json = false;  // the one object has been printed; the sentence goes to stderr
        throw Error(ErrorCode::failed,
                    fmt::format("{} task{} failed, the first {}; the rest is done, and the report "
                                "says what is missing",
                                failed.size(), failed.size() == 1 ? "" : "s", failed.front()),
                    folder.string());
    }
}

}  // namespace

void add_reproduce(CLI::App& app, Session& session) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "reproduce", "Every table and figure of the paper beside ours (docs/REPRODUCE.md)");
    command
        ->add_option("-o,--out", a->output,
                     "Result folder; run again with the same one, it goes on where it was")
        ->required();
    command
        ->add_option("--recordings", a->recordings,
                     "Two recordings in the places of the paper's chamber and open air (simulated)")
        ->expected(2);
    command->add_option("--copper", a->copper,
                        "Photographs of real copper, judged within their own recording");
    command->add_flag("--quick", a->quick,
                      "Small recordings, few windows, one network once: minutes, no evidence");
    command
        ->add_option("--jobs", a->jobs,
                     "Cores to use, by tasks side by side and their threads together (0: all)")
        ->check(CLI::Range(0, 4096));
    command->add_flag("--force", session.force,
                      "Go on with other settings; write into a folder with other files");
    command->add_flag("--json", session.json, "One JSON object on stdout instead of sentences");
    command->add_flag("-q,--quiet", session.quiet, "Only errors");
    command->callback([a, &session] { session.action = [a](Session& s) { run(s, *a); }; });
}

}  // namespace verdigris::cli
