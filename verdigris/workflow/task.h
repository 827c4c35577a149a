// SPDX-License-Identifier: MIT
// A step of a longer work: one command line of one program, what it reads and what it makes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace verdigris {

/// All paths are relative to the folder that the tasks share, or absolute.
struct Task {
    std::string id;     ///< letters, digits, "-", "_": names its record and its log
    std::string title;  ///< for people: "train patinanet on chamber"
    std::vector<std::string> arguments;  ///< of the program, without how many threads it may use
    /// Files or folders that must be there. What another task makes, or what lies in it, makes
    /// this one wait for that one.
    std::vector<std::filesystem::path> inputs = {};
    /// Files or folders that are there afterwards. They belong to the task: before it is done
    /// again they are removed. No two tasks make the same.
    std::vector<std::filesystem::path> outputs = {};
    /// Tasks to wait for, beyond those that make inputs.
    std::vector<std::string> after = {};
    /// What standard output is kept as, once the task is done; also an output. Empty: in the log.
    std::filesystem::path kept_output = {};
    /// Where a task that was stopped left this file, it goes on with `resume_option` behind its
    /// arguments; so it does after an exit status of 1 or a signal (a full disk, no memory). Empty:
    /// what it left is removed and it begins anew.
    std::filesystem::path resume_mark = {};
    std::string resume_option = {};
    double cost = 1;       ///< seconds of one core, about
    int most_threads = 0;  ///< 0: as many as are free
    /// Tasks of one kind err in the same direction: what one took corrects the others' cost.
    std::string kind = {};
    /// Why this program cannot do it, as a sentence; empty where it can.
    std::string missing = {};
};

/// The outputs with `kept_output`.
std::vector<std::filesystem::path> all_outputs(const Task& task);

}  // namespace verdigris
