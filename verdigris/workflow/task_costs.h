// SPDX-License-Identifier: MIT
// What tasks cost, corrected by what those that are done have taken (internal).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "verdigris/workflow/task_graph.h"

namespace verdigris {

class TaskCosts {
  public:
    explicit TaskCosts(const TaskGraph& graph) : graph_(graph) {}

    /// That task took `seconds` on `threads`.
    void measured(std::size_t task, double seconds, int threads);
    /// By kind: measured over estimated. Of a kind never measured it is that of all together.
    double factor(const std::string& kind) const;
    /// Seconds of one core.
    double cost(std::size_t task) const {
        return graph_.tasks()[task].cost * factor(graph_.tasks()[task].kind);
    }

  private:
    struct Sums {
        double measured = 0, estimated = 0;
    };
    const TaskGraph& graph_;
    std::map<std::string, Sums> kinds_;
    Sums all_;
};

}  // namespace verdigris
