// SPDX-License-Identifier: MIT
#include "task_printer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "session.h"

namespace verdigris::cli {

std::string clock_text(double seconds) {
    const int s = int(std::min(seconds, 1e8) + 0.5);
    if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
    return fmt::format("{}:{:02}", s / 60, s % 60);
}

TaskPrinter::TaskPrinter(bool silent)
    : silent_(silent), terminal_(isatty(STDERR_FILENO) == 1), last_print_(Clock::now()) {}

bool TaskPrinter::operator()(const WorkflowView& view) {
    if (interrupted()) {
        clear();
        if (!silent_) std::fprintf(stderr, "stopping: waiting for what runs to end\n");
        return false;
    }
    if (silent_) return true;
    const auto& tasks = view.graph.tasks();
    if (view.changed < tasks.size()) {
        const TaskOutcome& o = view.outcomes[view.changed];
        const bool ended = o.state != TaskState::waiting && o.state != TaskState::running;
        // Of what was done before only the sum is of interest, which the lines that follow show.
        if (ended && o.state != TaskState::up_to_date && o.state != TaskState::missing) {
            clear();
            std::fprintf(stderr, "[%d/%d] %-8s %s%s\n", view.ended, view.total,
                         to_string(o.state).c_str(), tasks[view.changed].title.c_str(),
                         o.state == TaskState::done
                             ? fmt::format(", {}", clock_text(o.wall_seconds)).c_str()
                             : fmt::format(": {}", o.sentence).c_str());
        }
    }
    const auto now = Clock::now();
    const auto pause = terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(10);
    if (now - last_print_ < pause) return true;
    last_print_ = now;
    std::string running;
    for (std::size_t i = 0; i < tasks.size(); ++i)
        if (view.outcomes[i].state == TaskState::running)
            running += (running.empty() ? "" : "; ") + tasks[i].title;
    if (running.empty()) return true;
    const std::string line = fmt::format("{} of {} done; running: {}; ETA {}", view.ended,
                                         view.total, running, clock_text(view.seconds_left));
    std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", line.c_str());
    std::fflush(stderr);
    drawn_ = terminal_;
    return true;
}

void TaskPrinter::clear() {
    if (drawn_) std::fprintf(stderr, "\r\033[K");
    drawn_ = false;
}

}  // namespace verdigris::cli
