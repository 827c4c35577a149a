// SPDX-License-Identifier: MIT
// Which command lines of the program make the paper's tables and figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/workflow/task.h"

namespace verdigris {

struct ReproductionOptions {
    /// In the places of the paper's chamber and open air; absolute. Empty: simulated.
    std::vector<std::filesystem::path> recordings = {};
    /// A folder of photographs of real copper, judged within itself; absolute. Empty: none.
    std::filesystem::path copper = {};
    /// Small recordings, few windows, one network for one epoch: to try it out, no evidence.
    bool quick = false;
    /// Why this build of the program has no networks, as a sentence; empty where it has.
    std::string no_networks = {};
};

/// The paper's four networks, in the order of its text.
const std::vector<std::string>& paper_networks();
/// Those that are trained: all, or where it is quick the first.
std::vector<std::string> trained_networks(const ReproductionOptions& options);

/// Where things lie in the result folder, relative to it.
std::filesystem::path reproduced_recording(const ReproductionOptions& options, int which);
/// What a network learned from recording `which` (0 or 1).
std::filesystem::path trained_run(const std::string& network, int which);

/// All tasks; those that this build cannot do say so. Costs are CPU seconds as measured on one core
/// (docs/REPRODUCE.md), of 984 frames of 128 x 128; other recordings cost something else.
std::vector<Task> reproduction_tasks(const ReproductionOptions& options);

/// A task's command as a user types it in the result folder: "verdigris evaluate ...".
std::string command_text(const Task& task);

}  // namespace verdigris
