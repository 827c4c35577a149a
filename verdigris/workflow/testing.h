// SPDX-License-Identifier: MIT
// Tasks of a few words for the shell, and what became of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/workflow/run_tasks.h"

namespace verdigris {

/// A task that says its id into runs.txt, then does `script`.
inline Task shell_task(const std::string& id, const std::string& script,
                       std::vector<std::filesystem::path> inputs,
                       std::vector<std::filesystem::path> outputs) {
    Task task;
    task.id = task.title = id;
    // What stands behind "sh" becomes $1 ... of the script.
    task.arguments = {"-c", "echo " + id + " >> runs.txt; " + script, "sh"};
    task.inputs = std::move(inputs);
    task.outputs = std::move(outputs);
    return task;
}

inline WorkflowOptions shell_options(const std::filesystem::path& folder) {
    WorkflowOptions options;
    options.program = "/bin/sh";
    options.folder = folder;
    options.version = "1";
    options.threads_option = "";
    options.patience = std::chrono::seconds(10);
    return options;
}

inline std::map<std::string, TaskState> states(const TaskGraph& graph,
                                               const std::vector<TaskOutcome>& outcomes) {
    std::map<std::string, TaskState> map;
    for (std::size_t i = 0; i < outcomes.size(); ++i) map[graph.tasks()[i].id] = outcomes[i].state;
    return map;
}

/// The ids in runs.txt, sorted, with blanks between; then the file is gone.
inline std::string runs(const std::filesystem::path& folder) {
    std::error_code error;
    if (!std::filesystem::exists(folder / "runs.txt", error)) return {};
    std::string text = read_text(folder / "runs.txt");
    std::filesystem::remove(folder / "runs.txt");
    for (char& c : text)
        if (c == '\n') c = ' ';
    if (!text.empty()) text.pop_back();
    return text;
}

}  // namespace verdigris
