// SPDX-License-Identifier: MIT
// A child process that does one task (internal).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace verdigris {

struct TaskExit {
    int status = 0;  ///< 128 + the signal, as a shell has it, where a signal ended it
    double cpu_seconds = 0;
};

/// Runs from construction on, in `folder`, in a process group of its own: what Ctrl-C sends to the
/// terminal's group does not reach it. It dies with the thread that made it, however that ends
/// (Linux). Standard input is empty, standard error goes to `log`, standard output to `output` or,
/// if that is empty, to `log` as well. What is still running when the object dies is killed.
/// Throws Error{failed}: a file that cannot be made, no process.
class RunningTask {
  public:
    RunningTask(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                const std::filesystem::path& folder, const std::filesystem::path& log,
                const std::filesystem::path& output);
    ~RunningTask();
    RunningTask(RunningTask&& other) noexcept;
    RunningTask& operator=(RunningTask&&) = delete;

    /// Once it has ended.
    std::optional<TaskExit> poll();
    void send(int signal);
    /// SIGINT now; SIGKILL if it has not ended after `patience`.
    TaskExit stop(std::chrono::milliseconds patience);
    double seconds() const;

  private:
    pid_t child_ = -1;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace verdigris
