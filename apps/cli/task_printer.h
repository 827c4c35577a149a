// SPDX-License-Identifier: MIT
// Tasks as they begin and end, and how long the rest will take, on stderr.
#pragma once

#include <chrono>
#include <string>

#include "verdigris/workflow/run_tasks.h"

namespace verdigris::cli {

/// "1:02:03" or "2:03".
std::string clock_text(double seconds);

/// A line for each task that ends; what runs and the ETA on a line of their own, which a terminal
/// redraws and a log gets every ten seconds.
class TaskPrinter {
  public:
    explicit TaskPrinter(bool silent);
    /// False once the user asked to stop.
    bool operator()(const WorkflowView& view);
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    bool silent_, terminal_, drawn_ = false;
    Clock::time_point last_print_;
};

}  // namespace verdigris::cli
