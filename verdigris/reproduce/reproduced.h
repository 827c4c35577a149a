// SPDX-License-Identifier: MIT
// A result folder after its tasks: what there is to read, and why the rest is not there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/reproduce/plan.h"
#include "verdigris/workflow/run_tasks.h"

namespace verdigris {

struct Reproduced {
    ReproductionOptions options;
    std::filesystem::path folder;
    const TaskGraph& graph;
    const std::vector<TaskOutcome>& outcomes;

    /// Nothing if there is no such task.
    const Task* task(const std::string& id) const;
    /// Done now or before?
    bool has(const std::string& id) const;
    /// "needs ..., which failed"; empty where it is there.
    std::string why_not(const std::string& id) const;
    /// "verdigris evaluate ... (35 s on 2 threads)"
    std::string made_by(const std::string& id) const;
    /// How recording `which` is called in our results.
    std::string recording(int which) const;
    /// "chamber -> air" of ours, in the paper's order of directions.
    std::string direction(int which) const;
    /// Behind every caption with numbers of ours: what they must not be taken for.
    std::string caution() const;
};

}  // namespace verdigris
