// SPDX-License-Identifier: MIT
// Stopped at any point: asked to, or killed. The next run goes on.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "verdigris/workflow/testing.h"

namespace verdigris {
namespace {
namespace fs = std::filesystem;

bool wait_for(const std::function<bool()>& there) {
    for (int i = 0; i < 1000; ++i) {
        if (there()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

/// quick -> slow: writes half of its output, waits for `go`, writes the rest.
std::vector<Task> slow_tasks() {
    return {shell_task("quick", "echo 1 > quick.txt", {}, {"quick.txt"}),
            shell_task("slow",
                       "mkdir out; echo half > out/half.txt; echo $$ > pid.txt; "
                       "while [ ! -e go ]; do sleep 0.02; done; echo whole > out/whole.txt",
                       {"quick.txt"}, {"out"})};
}

/// A training: an epoch is a line; three make it whole; `--resume` adds to what is there.
Task training() {
    Task task = shell_task("train",
                           "if [ \"$1\" != --resume ]; then mkdir run; fi; "
                           "while [ $(cat run/epochs 2>/dev/null | wc -l) -lt 3 ]; do "
                           "echo \"$1\" >> run/epochs; [ -e go ] || { echo $$ > pid.txt; "
                           "while [ ! -e go ]; do sleep 0.02; done; }; done",
                           {}, {"run"});
    task.resume_mark = "run/epochs";
    task.resume_option = "--resume";
    return task;
}

/// The workflow in a process of its own, killed once pid.txt is there. Gives the child's pid.
pid_t run_and_kill(const TaskGraph& graph, const WorkflowOptions& options) {
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            run_tasks(graph, options);
        } catch (...) {
        }
        ::_exit(0);
    }
    EXPECT_TRUE(wait_for([&] {
        return fs::exists(options.folder / "pid.txt") &&
               fs::file_size(options.folder / "pid.txt") > 1;
    }));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const pid_t task = pid_t(std::stol(read_text(options.folder / "pid.txt")));
    fs::remove(options.folder / "pid.txt");
    return task;
}

TEST(RunTasksStopped, AKilledRunLeavesNoChildAndIsDoneAgain) {
    const ScratchFolder folder;
    const TaskGraph graph(slow_tasks());
    const WorkflowOptions options = shell_options(folder.path());
    const pid_t task = run_and_kill(graph, options);
    EXPECT_TRUE(wait_for([&] { return ::kill(task, 0) != 0; })) << "a task outlives its parent";
    EXPECT_TRUE(fs::exists(folder / "out/half.txt"));
    const auto record = read_record(folder.path(), graph.tasks()[1]);
    ASSERT_TRUE(record);
    EXPECT_EQ(record->state, RecordState::begun);

    write_file(folder / "out/left.txt", "by the run that was killed");
    write_file(folder / "go", "");
    runs(folder.path());
    const auto result = states(graph, run_tasks(graph, options));
    EXPECT_EQ(result.at("quick"), TaskState::up_to_date);
    EXPECT_EQ(result.at("slow"), TaskState::done);
    EXPECT_EQ(runs(folder.path()), "slow");
    EXPECT_TRUE(fs::exists(folder / "out/whole.txt"));
    EXPECT_FALSE(fs::exists(folder / "out/left.txt")) << "what was half done was not cleaned";
}

TEST(RunTasksStopped, NoTemporaryOfAKilledTaskStaysBesideItsFile) {
    const ScratchFolder folder;
    // As AtomicFile does it: under another name until it is whole.
    const TaskGraph graph({shell_task(
        "film",
        "mkdir -p films; echo half > films/.film.mkv.$$-1.tmp; echo $$ > pid.txt; "
        "while [ ! -e go ]; do sleep 0.02; done; mv films/.film.mkv.$$-1.tmp films/film.mkv",
        {}, {"films/film.mkv"})});
    const WorkflowOptions options = shell_options(folder.path());
    run_and_kill(graph, options);
    const auto count = [&] {
        return std::distance(fs::directory_iterator(folder / "films"), fs::directory_iterator());
    };
    EXPECT_EQ(count(), 1);
    write_file(folder / "go", "");
    EXPECT_EQ(states(graph, run_tasks(graph, options)).at("film"), TaskState::done);
    EXPECT_TRUE(fs::exists(folder / "films/film.mkv"));
    EXPECT_EQ(count(), 1) << "what was half written was left";
}

TEST(RunTasksStopped, WhatCanGoOnGoesOn) {
    const ScratchFolder folder;
    const TaskGraph graph({training()});
    const WorkflowOptions options = shell_options(folder.path());
    run_and_kill(graph, options);
    write_file(folder / "go", "");
    EXPECT_EQ(states(graph, run_tasks(graph, options)).at("train"), TaskState::done);
    EXPECT_EQ(read_text(folder / "run/epochs"), "\n--resume\n--resume\n");
}

TEST(RunTasksStopped, WhatHasOtherArgumentsSinceBeginsAnew) {
    const ScratchFolder folder;
    const WorkflowOptions options = shell_options(folder.path());
    run_and_kill(TaskGraph({training()}), options);
    write_file(folder / "go", "");
    Task other = training();
    other.arguments.push_back("other");
    const TaskGraph graph({other});
    run_tasks(graph, options);
    EXPECT_EQ(read_text(folder / "run/epochs"), "other\nother\nother\n");
}

TEST(RunTasksStopped, AFullDiskDoesNotThrowEpochsAway) {
    const ScratchFolder folder;
    write_file(folder / "go", "");
    Task task = training();
    task.arguments[1] += "; [ -e room ] || { echo 'the disk is full' >&2; exit 1; }";
    const TaskGraph graph({task});
    const WorkflowOptions options = shell_options(folder.path());
    const auto outcomes = run_tasks(graph, options);
    EXPECT_EQ(outcomes[0].state, TaskState::failed);
    EXPECT_EQ(outcomes[0].sentence, "the disk is full");
    write_file(folder / "room", "");
    EXPECT_EQ(run_tasks(graph, options)[0].state, TaskState::done);
    EXPECT_EQ(read_text(folder / "run/epochs"), "\n\n\n");
}

TEST(RunTasksStopped, AskedToStopItEndsItsChildrenFirst) {
    const ScratchFolder folder;
    const TaskGraph graph(slow_tasks());
    const WorkflowOptions options = shell_options(folder.path());
    const auto until_it_runs = [&](const WorkflowView& view) {
        EXPECT_LE(view.ended, view.total);
        return !fs::exists(folder / "pid.txt");
    };
    try {
        run_tasks(graph, options, until_it_runs);
        ADD_FAILURE() << "was not stopped";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::interrupted);
    }
    const pid_t task = pid_t(std::stol(read_text(folder / "pid.txt")));
    EXPECT_NE(::kill(task, 0), 0) << "a task runs on";
    EXPECT_EQ(read_record(folder.path(), graph.tasks()[0])->state, RecordState::done);
    write_file(folder / "go", "");
    EXPECT_EQ(states(graph, run_tasks(graph, options)).at("slow"), TaskState::done);
}

TEST(RunTasksStopped, WhoDoesNotListenIsKilled) {
    const ScratchFolder folder;
    const TaskGraph graph({shell_task(
        "deaf", "trap '' INT; echo $$ > pid.txt; while true; do sleep 0.05; done", {}, {"out"})});
    WorkflowOptions options = shell_options(folder.path());
    options.patience = std::chrono::milliseconds(200);
    EXPECT_THROW(run_tasks(graph, options,
                           [&](const WorkflowView&) { return !fs::exists(folder / "pid.txt"); }),
                 Error);
    EXPECT_NE(::kill(pid_t(std::stol(read_text(folder / "pid.txt"))), 0), 0);
}

}  // namespace
}  // namespace verdigris
