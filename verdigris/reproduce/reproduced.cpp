// SPDX-License-Identifier: MIT
#include "verdigris/reproduce/reproduced.h"

#include <fmt/format.h>

#include <algorithm>

#include "verdigris/reproduce/paper_values.h"

namespace verdigris {
namespace {

std::size_t index_of(const Reproduced& r, const std::string& id) {
    const auto& tasks = r.graph.tasks();
    return std::size_t(std::ranges::find(tasks, id, &Task::id) - tasks.begin());
}

}  // namespace

const Task* Reproduced::task(const std::string& id) const {
    const std::size_t i = index_of(*this, id);
    return i < graph.tasks().size() ? &graph.tasks()[i] : nullptr;
}

bool Reproduced::has(const std::string& id) const {
    const std::size_t i = index_of(*this, id);
    return i < outcomes.size() &&
           (outcomes[i].state == TaskState::done || outcomes[i].state == TaskState::up_to_date);
}

std::string Reproduced::why_not(const std::string& id) const {
    const std::size_t i = index_of(*this, id);
    if (i >= outcomes.size()) return "it was not asked for";
    return has(id) ? "" : outcomes[i].sentence;
}

std::string Reproduced::made_by(const std::string& id) const {
    const std::size_t i = index_of(*this, id);
    if (i >= outcomes.size()) return {};
    const TaskOutcome& o = outcomes[i];
    return command_text(graph.tasks()[i]) + fmt::format("  ({:.0f} s on {} thread{})",
                                                        o.wall_seconds, o.threads,
                                                        o.threads == 1 ? "" : "s");
}

std::string Reproduced::recording(int which) const {
    std::filesystem::path path = reproduced_recording(options, which);
    if (!path.has_filename()) path = path.parent_path();
    const std::string name = std::filesystem::is_directory(folder / path) ? path.filename().string()
                                                                          : path.stem().string();
    // As the commands call the second of one name.
    return which == 1 && name == recording(0) ? name + " (2)" : name;
}

std::string Reproduced::direction(int which) const {
    return which == kChamberToAir ? recording(0) + " -> " + recording(1)
                                  : recording(1) + " -> " + recording(0);
}

std::string Reproduced::caution() const {
    return options.quick ? " Quick: not the paper's settings; no evidence." : "";
}

}  // namespace verdigris
