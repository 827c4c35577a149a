// SPDX-License-Identifier: MIT
#include "verdigris/workflow/task_graph.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <set>
#include <utility>

#include "verdigris/error.h"

namespace verdigris {
namespace fs = std::filesystem;
namespace {

bool is_id(const std::string& id) {
    return !id.empty() && id.size() <= 80 && std::ranges::all_of(id, [](unsigned char c) {
        return std::isalnum(c) || c == '-' || c == '_';
    });
}

[[noreturn]] void fail(const Task& task, const std::string& what) {
    throw Error(ErrorCode::usage, what, "task " + task.id);
}

fs::path plain(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

/// The same, or below it.
bool lies_in(const fs::path& path, const fs::path& folder) {
    const auto [a, b] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return a == folder.end();
}

}  // namespace

std::vector<fs::path> all_outputs(const Task& task) {
    std::vector<fs::path> all = task.outputs;
    if (!task.kept_output.empty()) all.push_back(task.kept_output);
    return all;
}

TaskGraph::TaskGraph(std::vector<Task> tasks) : tasks_(std::move(tasks)), needs_(tasks_.size()) {
    std::map<std::string, std::size_t> by_id;
    std::vector<std::pair<fs::path, std::size_t>> made;
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        const Task& task = tasks_[i];
        if (!is_id(task.id)) fail(task, "'" + task.id + "' is no id");
        if (!by_id.emplace(task.id, i).second) fail(task, "there are two of this id");
        if (all_outputs(task).empty()) fail(task, "makes nothing");
        for (const fs::path& output : all_outputs(task)) {
            const fs::path path = plain(output);
            for (const auto& [other, maker] : made) {
                if (maker != i && (lies_in(path, other) || lies_in(other, path)))
                    fail(task,
                         "makes " + output.string() + ", which " + tasks_[maker].id + " makes too");
            }
            made.emplace_back(path, i);
        }
    }
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        std::set<std::size_t> needs;
        for (const std::string& id : tasks_[i].after) {
            const auto found = by_id.find(id);
            if (found == by_id.end()) fail(tasks_[i], "is after '" + id + "', which is no task");
            needs.insert(found->second);
        }
        for (const fs::path& input : tasks_[i].inputs)
            for (const auto& [path, maker] : made)
                if (lies_in(plain(input), path)) needs.insert(maker);
        needs_[i].assign(needs.begin(), needs.end());
    }
    std::vector<bool> placed(tasks_.size());
    while (order_.size() < tasks_.size()) {
        const std::size_t before = order_.size();
        for (std::size_t i = 0; i < tasks_.size(); ++i) {
            if (placed[i] || !std::ranges::all_of(needs_[i], [&](auto k) { return placed[k]; }))
                continue;
            placed[i] = true;
            order_.push_back(i);
        }
        if (order_.size() == before)
            fail(tasks_[std::size_t(std::ranges::find(placed, false) - placed.begin())],
                 "waits in a circle for what itself makes");
    }
}

std::vector<double> TaskGraph::costs_to_end(const std::map<std::string, double>& factors) const {
    std::vector<double> cost(tasks_.size()), behind(tasks_.size(), 0);
    for (auto it = order_.rbegin(); it != order_.rend(); ++it) {
        const auto factor = factors.find(tasks_[*it].kind);
        cost[*it] = behind[*it] + tasks_[*it].cost * (factor == factors.end() ? 1 : factor->second);
        for (const std::size_t need : needs_[*it]) behind[need] = std::max(behind[need], cost[*it]);
    }
    return cost;
}

int threads_for(const Task& task, int free, int waiting) {
    const int share = free / std::max(1, waiting + 1);
    const int most = task.most_threads > 0 ? task.most_threads : free;
    return std::clamp(share, 1, std::max(1, most));
}

double estimated_seconds(const TaskGraph& graph, const std::vector<double>& cost,
                         const std::vector<bool>& left, int cores) {
    struct Running {
        double ends;
        std::size_t task;
        int threads;
    };
    std::vector<bool> waiting = left, done(left.size());
    for (std::size_t i = 0; i < left.size(); ++i) done[i] = !left[i];
    const std::vector<double> urgency = graph.costs_to_end();
    std::vector<Running> running;
    double now = 0;
    int free = std::max(1, cores);
    for (;;) {
        std::vector<std::size_t> ready;
        for (std::size_t i = 0; i < left.size(); ++i) {
            if (waiting[i] &&
                std::ranges::all_of(graph.needs(i), [&](std::size_t k) { return done[k]; }))
                ready.push_back(i);
        }
        std::ranges::stable_sort(ready, [&](auto a, auto b) { return urgency[a] > urgency[b]; });
        for (std::size_t r = 0; r < ready.size() && free > 0; ++r) {
            const int threads =
                threads_for(graph.tasks()[ready[r]], free, int(ready.size() - r - 1));
            running.push_back({now + cost[ready[r]] / threads, ready[r], threads});
            waiting[ready[r]] = false;
            free -= threads;
        }
        if (running.empty()) return now;
        const auto next = std::ranges::min_element(running, {}, &Running::ends);
        now = next->ends;
        done[next->task] = true;
        free += next->threads;
        running.erase(next);
    }
}

}  // namespace verdigris
