// SPDX-License-Identifier: MIT
// Another program, run to its end: no shell, nothing of the script on disk, never forever.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace verdigris {

/// Where `name` is on PATH; empty if it is not there or may not be executed.
std::filesystem::path find_program(const std::string& name);

struct ProcessCall {
    std::filesystem::path program;       ///< a path, as find_program gives it
    std::vector<std::string> arguments;  ///< without the program's own name
    std::string input;                   ///< all of its standard input
    std::chrono::milliseconds timeout = std::chrono::seconds(60);
};

struct ProcessResult {
    int exit_status = 0;
    std::string output, errors;  ///< standard output and standard error, whole
};

/// Runs the program in the C.UTF-8 locale and waits. A non-zero exit status is a result, not an
/// exception. Throws Error{failed}: it cannot be started, was ended by a signal, or took longer
/// than `timeout` (then it is killed). Cost: a process; its output is held in memory.
ProcessResult run_process(const ProcessCall& call);

}  // namespace verdigris
