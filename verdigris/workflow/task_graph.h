// SPDX-License-Identifier: MIT
// Tasks in an order in which they can be done.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "verdigris/workflow/task.h"

namespace verdigris {

class TaskGraph {
  public:
    /// Throws Error{usage} naming the task: an id that is none or is used twice, no outputs, an
    /// output of two tasks or inside another's, `after` what is not there, a circle.
    explicit TaskGraph(std::vector<Task> tasks);

    const std::vector<Task>& tasks() const { return tasks_; }
    /// Indices of the tasks that task i waits for, increasing.
    const std::vector<std::size_t>& needs(std::size_t i) const { return needs_[i]; }
    /// Every task after those it needs; among those that are free, as they were given.
    const std::vector<std::size_t>& order() const { return order_; }
    /// Of each task, the cost of the most costly way from its start to an end, itself included,
    /// each task's cost multiplied by `factor` of its kind (1 where there is none).
    std::vector<double> costs_to_end(const std::map<std::string, double>& factors = {}) const;

  private:
    std::vector<Task> tasks_;
    std::vector<std::vector<std::size_t>> needs_;
    std::vector<std::size_t> order_;
};

/// Seconds until all tasks in `left` are done on `cores`: task i still takes `cost[i]` seconds of
/// one core, tasks whose needs are done begin in the order of `costs_to_end`, and one that takes
/// several threads is as many times as fast. What runs already is begun first.
double estimated_seconds(const TaskGraph& graph, const std::vector<double>& cost,
                         const std::vector<bool>& left, int cores);

/// The most that task may use of `free` cores while `waiting` others could begin too. At least 1.
int threads_for(const Task& task, int free, int waiting);

}  // namespace verdigris
