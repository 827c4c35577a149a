// SPDX-License-Identifier: MIT
// What is known of a task from runs before: written whole, one file per task.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "verdigris/workflow/fingerprint.h"
#include "verdigris/workflow/task.h"

namespace verdigris {

enum class RecordState {
    begun,   ///< it runs, or was stopped
    failed,  ///< it ended with another exit status than 0
    done,
};

struct TaskRecord {
    RecordState state = RecordState::begun;
    std::vector<std::string> command;  ///< Task::arguments
    std::string version;               ///< of the program
    std::string build = {};            ///< SHA-256 of the program: told, not compared
    std::map<std::string, Fingerprint> inputs, outputs;  ///< by path as the task has it
    double wall_seconds = 0;                             ///< of all runs that led here
    double cpu_seconds = 0;                              ///< of the last one
    int threads = 0;
    int exit_status = 0;
};

/// `<folder>/tasks/<id>.json`
std::filesystem::path record_path(const std::filesystem::path& folder, const Task& task);
/// `<folder>/tasks/<id>.log`
std::filesystem::path log_path(const std::filesystem::path& folder, const Task& task);

/// Nothing where there is none, or none of ours: then the task has never been done.
std::optional<TaskRecord> read_record(const std::filesystem::path& folder, const Task& task);
/// Throws Error{failed}: what cannot be written.
void write_record(const std::filesystem::path& folder, const Task& task, const TaskRecord& record);

/// Those of the task's inputs as they are now. Throws as fingerprint().
std::map<std::string, Fingerprint> input_prints(const std::filesystem::path& folder,
                                                const Task& task,
                                                const std::optional<TaskRecord>& known);
/// As input_prints, of what it makes.
std::map<std::string, Fingerprint> output_prints(const std::filesystem::path& folder,
                                                 const Task& task,
                                                 const std::optional<TaskRecord>& known);

/// Same command, version, and bytes of the inputs?
bool same_work(const TaskRecord& record, const Task& task, const std::string& version,
               const std::map<std::string, Fingerprint>& inputs);

}  // namespace verdigris
