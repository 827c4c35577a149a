// SPDX-License-Identifier: MIT
#include "verdigris/workflow/run_tasks.h"

#include <algorithm>
#include <csignal>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/workflow/running_task.h"
#include "verdigris/workflow/task_costs.h"

namespace verdigris {
namespace fs = std::filesystem;
namespace {

bool is_there(const fs::path& path) {
    std::error_code error;
    return fs::exists(fs::symlink_status(path, error));
}

std::string last_line(const fs::path& log) {
    std::string text;
    try {
        text = read_text(log);
    } catch (const Error&) {
        return {};
    }
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    const std::size_t at = text.find_last_of("\n\r");
    return text.substr(at == std::string::npos ? 0 : at + 1).substr(0, 600);
}

class Workflow {
  public:
    Workflow(const TaskGraph& graph, const WorkflowOptions& options,
             const WorkflowProgress& progress)
        : graph_(graph),
          options_(options),
          progress_(progress),
          outcomes_(graph.tasks().size()),
          costs_(graph),
          free_(std::max(1, options.cores)) {
        for (std::size_t i = 0; i < outcomes_.size(); ++i) {
            records_.push_back(read_record(options_.folder, task(i)));
            refuse_what_is_not_ours(i);
            if (records_[i] && records_[i]->state == RecordState::done)
                costs_.measured(i, records_[i]->wall_seconds, records_[i]->threads);
        }
        std::error_code error;
        fs::create_directories(options_.folder / "tasks", error);
        if (error)
            throw Error(ErrorCode::failed, "cannot be made: " + error.message(),
                        (options_.folder / "tasks").string());
    }

    std::vector<TaskOutcome> run() {
        for (;;) {
            settle_and_start();
            tell(outcomes_.size());
            if (running_.empty()) return outcomes_;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            for (auto it = running_.begin(); it != running_.end();) {
                if (const auto ended = it->child.poll()) {
                    finish(*it, *ended);
                    const std::size_t i = it->task;
                    it = running_.erase(it);
                    tell(i);
                } else {
                    ++it;
                }
            }
        }
    }

  private:
    struct Running {
        std::size_t task;
        int threads;
        double before;  ///< seconds of runs that this one goes on with
        RunningTask child;
    };

    const Task& task(std::size_t i) const { return graph_.tasks()[i]; }
    fs::path in_folder(const fs::path& path) const { return options_.folder / path; }
    fs::path unfinished_output(std::size_t i) const {
        return options_.folder / "tasks" / (task(i).id + ".out");
    }

    // What is removed must be what an earlier run of ours began to make.
    void refuse_what_is_not_ours(std::size_t i) const {
        if (records_[i]) return;
        for (const fs::path& output : all_outputs(task(i)))
            if (is_there(in_folder(output)))
                throw Error(ErrorCode::refused,
                            "is there already, and nothing in tasks/ says that it was made here; "
                            "choose another folder",
                            in_folder(output).string());
    }

    void end(std::size_t i, TaskState state, std::string sentence = {}) {
        outcomes_[i].state = state;
        outcomes_[i].sentence = std::move(sentence);
        tell(i);
    }

    /// Tasks whose needs are settled: without a process where there is nothing to do or no way.
    void settle_and_start() {
        std::vector<std::size_t> ready;
        for (const std::size_t i : graph_.order()) {
            if (outcomes_[i].state != TaskState::waiting) continue;
            const auto state = [&](std::size_t k) { return outcomes_[k].state; };
            const auto is_open = [&](std::size_t k) {
                return state(k) == TaskState::waiting || state(k) == TaskState::running;
            };
            const auto gives = [&](std::size_t k) {
                return state(k) == TaskState::done || state(k) == TaskState::up_to_date;
            };
            if (!task(i).missing.empty()) {
                end(i, TaskState::missing, task(i).missing);
            } else if (std::ranges::any_of(graph_.needs(i), is_open)) {
                continue;
            } else if (const auto lost = std::ranges::find_if_not(graph_.needs(i), gives);
                       lost != graph_.needs(i).end()) {
                end(i, TaskState::skipped,
                    "needs \"" + task(*lost).title + "\", which " +
                        (state(*lost) == TaskState::failed    ? "failed"
                         : state(*lost) == TaskState::missing ? "this build does not have"
                                                              : "was skipped"));
            } else if (!settled_by_record(i)) {
                ready.push_back(i);
            }
        }
        const std::vector<double> urgency = graph_.costs_to_end();
        std::ranges::stable_sort(ready, [&](auto a, auto b) { return urgency[a] > urgency[b]; });
        for (std::size_t r = 0; r < ready.size() && free_ > 0; ++r)
            start(ready[r], threads_for(task(ready[r]), free_, int(ready.size() - r - 1)));
    }

    bool settled_by_record(std::size_t i) {
        if (checked_.contains(i)) return false;
        try {
            inputs_[i] = input_prints(options_.folder, task(i), records_[i]);
        } catch (const Error& e) {
            end(i, TaskState::failed, e.what());
            return true;
        }
        checked_.insert(i);
        const auto& record = records_[i];
        if (!record || record->state != RecordState::done ||
            !same_work(*record, task(i), options_.version, inputs_[i]))
            return false;
        for (const fs::path& output : all_outputs(task(i)))
            if (!is_there(in_folder(output))) return false;
        const auto outputs = output_prints(options_.folder, task(i), record);
        for (const auto& [path, print] : outputs) {
            const auto before = record->outputs.find(path);
            if (before == record->outputs.end() || before->second.content != print.content)
                return false;
        }
        TaskOutcome& outcome = outcomes_[i];
        outcome.wall_seconds = record->wall_seconds;
        outcome.cpu_seconds = record->cpu_seconds;
        outcome.threads = record->threads;
        outcome.other_build = record->build != options_.build;
        end(i, TaskState::up_to_date);
        return true;
    }

    bool goes_on(std::size_t i) const {
        const auto& record = records_[i];
        return record && record->state == RecordState::begun && !task(i).resume_mark.empty() &&
               is_there(in_folder(task(i).resume_mark)) &&
               same_work(*record, task(i), options_.version, inputs_.at(i));
    }

    void clean(std::size_t i) const {
        for (const fs::path& output : all_outputs(task(i))) {
            std::error_code error;
            fs::remove_all(in_folder(output), error);
            if (error)
                throw Error(ErrorCode::failed, "cannot be removed: " + error.message(),
                            in_folder(output).string());
            remove_abandoned(in_folder(output));  // a folder's went with it; a file's lie beside it
            fs::create_directories(in_folder(output).parent_path(), error);
        }
    }

    void start(std::size_t i, int threads) {
        const bool resumed = goes_on(i);
        const double before = resumed ? records_[i]->wall_seconds : 0;
        TaskRecord record;
        record.command = task(i).arguments;
        record.version = options_.version;
        record.build = options_.build;
        record.inputs = inputs_[i];
        record.threads = threads;
        record.wall_seconds = before;
        // Before anything is touched: from here on, what lies there is known to be half done.
        write_record(options_.folder, task(i), record);
        records_[i] = record;
        if (!resumed) clean(i);
        std::vector<std::string> arguments = task(i).arguments;
        if (resumed) arguments.push_back(task(i).resume_option);
        if (!options_.threads_option.empty()) {
            arguments.push_back(options_.threads_option);
            arguments.push_back(std::to_string(threads));
        }
        running_.push_back(
            {i, threads, before,
             RunningTask(options_.program, arguments, options_.folder,
                         log_path(options_.folder, task(i)),
                         task(i).kept_output.empty() ? fs::path() : unfinished_output(i))});
        free_ -= threads;
        outcomes_[i].state = TaskState::running;
        outcomes_[i].threads = threads;
        tell(i);
    }

    void finish(Running& run, const TaskExit& exit) {
        const std::size_t i = run.task;
        free_ += run.threads;
        TaskRecord& record = *records_[i];
        TaskOutcome& outcome = outcomes_[i];
        outcome.wall_seconds = record.wall_seconds = run.before + run.child.seconds();
        outcome.cpu_seconds = record.cpu_seconds = exit.cpu_seconds;
        outcome.exit_status = record.exit_status = exit.status;
        std::string problem;
        if (exit.status > 128) {
            problem = "was ended by signal " + std::to_string(exit.status - 128);
        } else if (exit.status != 0) {
            problem = last_line(log_path(options_.folder, task(i)));
            if (problem.empty()) problem = "ended with exit status " + std::to_string(exit.status);
        } else {
            problem = keep_outputs(i, record);
        }
        record.state = problem.empty() ? RecordState::done : RecordState::failed;
        if (problem.empty()) {
            costs_.measured(i, record.wall_seconds, run.threads);
        } else if (!task(i).resume_mark.empty() &&
                   (exit.status == int(ErrorCode::failed) || exit.status > 128)) {
            record.state = RecordState::begun;  // the disk, the memory: hours are not thrown away
        } else {
            clean(i);  // half a result must not be taken for one
        }
        write_record(options_.folder, task(i), record);
        outcome.state = problem.empty() ? TaskState::done : TaskState::failed;
        outcome.sentence = problem;
    }

    /// What is wrong with them, or nothing.
    std::string keep_outputs(std::size_t i, TaskRecord& record) {
        std::error_code error;
        if (!task(i).kept_output.empty()) {
            fs::rename(unfinished_output(i), in_folder(task(i).kept_output), error);
            if (error) return "what it said cannot be kept: " + error.message();
        }
        for (const fs::path& output : all_outputs(task(i)))
            if (!is_there(in_folder(output))) return "ended well without making " + output.string();
        record.outputs = output_prints(options_.folder, task(i), {});
        return {};
    }

    void tell(std::size_t changed) {
        if (!progress_) return;
        WorkflowView view{graph_, outcomes_, 0, 0, 0, changed};
        std::vector<double> cost(outcomes_.size());
        std::vector<bool> left(outcomes_.size());
        for (std::size_t i = 0; i < outcomes_.size(); ++i) {
            const TaskState state = outcomes_[i].state;
            view.total += task(i).missing.empty();
            left[i] = state == TaskState::waiting || state == TaskState::running;
            view.ended += !left[i] && state != TaskState::missing;
            cost[i] = costs_.cost(i);
        }
        for (const Running& run : running_)
            cost[run.task] =
                std::max(0.02 * cost[run.task],
                         cost[run.task] - (run.before + run.child.seconds()) * double(run.threads));
        view.seconds_left = estimated_seconds(graph_, cost, left, options_.cores);
        if (progress_(view)) return;
        stop_all();
        throw Error(ErrorCode::interrupted, "stopped; run it again to go on");
    }

    void stop_all() {
        for (Running& run : running_) run.child.send(SIGINT);
        for (Running& run : running_) {
            run.child.stop(options_.patience);
            // The record still says "begun": the next run cleans up or goes on.
            TaskRecord& record = *records_[run.task];
            record.wall_seconds = run.before + run.child.seconds();
            write_record(options_.folder, task(run.task), record);
        }
        running_.clear();
    }

    const TaskGraph& graph_;
    const WorkflowOptions& options_;
    const WorkflowProgress& progress_;
    std::vector<TaskOutcome> outcomes_;
    std::vector<std::optional<TaskRecord>> records_;
    std::map<std::size_t, std::map<std::string, Fingerprint>> inputs_;
    std::set<std::size_t> checked_;
    std::list<Running> running_;
    TaskCosts costs_;
    int free_;
};

}  // namespace

std::string to_string(TaskState state) {
    switch (state) {
        case TaskState::waiting:
            return "waiting";
        case TaskState::running:
            return "running";
        case TaskState::up_to_date:
            return "up to date";
        case TaskState::done:
            return "done";
        case TaskState::failed:
            return "failed";
        case TaskState::skipped:
            return "skipped";
        case TaskState::missing:
            return "missing";
    }
    return {};
}

std::vector<TaskOutcome> run_tasks(const TaskGraph& graph, const WorkflowOptions& options,
                                   const WorkflowProgress& progress) {
    return Workflow(graph, options, progress).run();
}

WorkflowEstimate estimate_tasks(const TaskGraph& graph, const WorkflowOptions& options) {
    TaskCosts costs(graph);
    std::vector<bool> left(graph.tasks().size());
    std::vector<double> cost(graph.tasks().size());
    WorkflowEstimate estimate;
    for (const std::size_t i : graph.order()) {
        const Task& task = graph.tasks()[i];
        const auto record = read_record(options.folder, task);
        const bool done = record && record->state == RecordState::done &&
                          record->command == task.arguments && record->version == options.version &&
                          std::ranges::all_of(all_outputs(task), [&](const fs::path& output) {
                              return is_there(options.folder / output);
                          });
        if (done) costs.measured(i, record->wall_seconds, record->threads);
        const bool behind =
            std::ranges::any_of(graph.needs(i), [&](std::size_t k) { return bool(left[k]); });
        left[i] = task.missing.empty() && (!done || behind);
        estimate.tasks += left[i];
    }
    for (std::size_t i = 0; i < left.size(); ++i) cost[i] = costs.cost(i);
    estimate.seconds = estimated_seconds(graph, cost, left, options.cores);
    return estimate;
}

}  // namespace verdigris
