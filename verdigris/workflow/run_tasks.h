// SPDX-License-Identifier: MIT
// Does the tasks of a graph as child processes, side by side, and only those that must be done.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verdigris/workflow/task_graph.h"
#include "verdigris/workflow/task_record.h"

namespace verdigris {

enum class TaskState {
    waiting,
    running,
    up_to_date,  ///< done by a run before: same command, version, inputs; outputs untouched
    done,        ///< by this run
    failed,
    skipped,  ///< something that it needs failed, is missing or was skipped
    missing,  ///< Task::missing
};
std::string to_string(TaskState state);

struct TaskOutcome {
    TaskState state = TaskState::waiting;
    std::string sentence;     ///< why it failed, was skipped or is missing; empty otherwise
    double wall_seconds = 0;  ///< of all runs that led to what is there
    double cpu_seconds = 0;
    int threads = 0;
    int exit_status = 0;
    bool other_build = false;  ///< up to date, but of another WorkflowOptions::build
};

/// For whoever shows it: called several times a second.
struct WorkflowView {
    const TaskGraph& graph;
    const std::vector<TaskOutcome>& outcomes;
    int ended = 0, total = 0;  ///< `total` without what is missing
    double seconds_left = 0;   ///< estimated; at least
    /// The task whose state changed, or none: the number of tasks.
    std::size_t changed = 0;
};

struct WorkflowOptions {
    std::filesystem::path program;  ///< all tasks are command lines of it
    std::filesystem::path folder;   ///< where they run, absolute; records and logs in tasks/
    std::string version;            ///< of the program: another one does all tasks again
    /// SHA-256 of the program: another one of the same version is only told (other_build).
    std::string build = {};
    int cores = 1;  ///< that all running tasks together may use
    /// Precedes the number of threads behind a task's arguments; empty: no task is told.
    std::string threads_option = "--threads";
    /// How long a task may take to end by itself once it was asked to.
    std::chrono::milliseconds patience = std::chrono::seconds(60);
};

/// False: stop.
using WorkflowProgress = std::function<bool(const WorkflowView&)>;

/// One outcome per task, none `waiting` or `running`. What a failed task would have made is not
/// there; what does not need it is done. A task that was stopped, by whatever, is cleaned up and
/// done again by the next call, or goes on (Task::resume_option). The folder is for one process at
/// a time: hold a FolderLock.
/// Throws Error{refused} before anything is run, where an output is there that no record of ours
/// speaks of: it would be removed. Error{interrupted} when `progress` said so, after all children
/// have ended. Error{failed}: a record that cannot be written.
std::vector<TaskOutcome> run_tasks(const TaskGraph& graph, const WorkflowOptions& options,
                                   const WorkflowProgress& progress = {});

/// What run_tasks would take by the costs alone, corrected by what records say that finished tasks
/// took. Looks at outputs and records, not at bytes: of what is done already it may be wrong.
struct WorkflowEstimate {
    double seconds = 0;  ///< on `cores`
    int tasks = 0;       ///< that are not done yet
};
WorkflowEstimate estimate_tasks(const TaskGraph& graph, const WorkflowOptions& options);

}  // namespace verdigris
