// SPDX-License-Identifier: MIT
#include "verdigris/workflow/run_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "verdigris/workflow/testing.h"

namespace verdigris {
namespace {
namespace fs = std::filesystem;

/// source -> first -> second, and source -> beside.
std::vector<Task> chain() {
    return {
        shell_task("second", "cat first.txt first.txt > second.txt", {"first.txt"}, {"second.txt"}),
        shell_task("first", "sort source > first.txt", {"source"}, {"first.txt"}),
        shell_task("beside", "cp source beside.txt", {"source"}, {"beside.txt"})};
}

class RunTasks : public ::testing::Test {
  protected:
    void SetUp() override {
        write_file(scratch_ / "source", "b\na\n");
        options_ = shell_options(scratch_.path());
    }
    std::map<std::string, TaskState> run(std::vector<Task> tasks) {
        const TaskGraph graph(std::move(tasks));
        outcomes_ = run_tasks(graph, options_);
        return states(graph, outcomes_);
    }
    std::string ran() { return runs(scratch_.path()); }

    ScratchFolder scratch_;
    WorkflowOptions options_;
    std::vector<TaskOutcome> outcomes_;
};

TEST_F(RunTasks, DoesThemInOrderAndThenNeverAgain) {
    const auto first = run(chain());
    EXPECT_EQ(first.at("second"), TaskState::done);
    EXPECT_EQ(read_text(scratch_ / "second.txt"), "a\nb\na\nb\n");
    const std::string order = ran();
    EXPECT_LT(order.find("first"), order.find("second"));
    for (const auto& [id, state] : run(chain())) EXPECT_EQ(state, TaskState::up_to_date) << id;
    EXPECT_EQ(ran(), "");
}

TEST_F(RunTasks, DoesAgainWhatAChangedInputReaches) {
    run(chain());
    ran();
    write_file(scratch_ / "source", "a\nb\n");  // sorted, it is the same as before
    const auto again = run(chain());
    EXPECT_EQ(again.at("first"), TaskState::done);
    EXPECT_EQ(again.at("beside"), TaskState::done);
    EXPECT_EQ(again.at("second"), TaskState::up_to_date) << "what it reads is as it was";
    write_file(scratch_ / "source", "c\n");
    EXPECT_EQ(run(chain()).at("second"), TaskState::done);
    EXPECT_EQ(read_text(scratch_ / "second.txt"), "c\nc\n");
    // Touched is not changed.
    ran();
    write_file(scratch_ / "source", "c\n");
    run(chain());
    EXPECT_EQ(ran(), "");
}

TEST_F(RunTasks, DoesAgainWhatHasOtherArgumentsOrAnotherVersion) {
    run(chain());
    ran();
    auto tasks = chain();
    tasks[2].arguments.push_back("--another");
    run(tasks);
    EXPECT_EQ(ran(), "beside");
    // Built again it is the same version: told, and not done again.
    options_.build = "built again";
    EXPECT_EQ(run(tasks).at("beside"), TaskState::up_to_date);
    EXPECT_TRUE(outcomes_[2].other_build);
    options_.version = "2";
    const auto again = run(tasks);
    EXPECT_TRUE(
        std::ranges::all_of(again, [](const auto& s) { return s.second == TaskState::done; }));
}

TEST_F(RunTasks, DoesAgainWhatIsGoneOrWasChangedByHand) {
    run(chain());
    ran();
    fs::remove(scratch_ / "beside.txt");
    run(chain());
    EXPECT_EQ(ran(), "beside");
    write_file(scratch_ / "second.txt", "by hand");
    run(chain());
    EXPECT_EQ(ran(), "second");
    EXPECT_EQ(read_text(scratch_ / "second.txt"), "a\nb\na\nb\n");
}

TEST_F(RunTasks, GoesOnBesideAFailure) {
    auto tasks = chain();
    tasks[1] = shell_task("first", "echo half > first.txt; echo 'no luck today' >&2; exit 3",
                          {"source"}, {"first.txt"});
    const auto result = run(tasks);
    EXPECT_EQ(result.at("first"), TaskState::failed);
    EXPECT_EQ(outcomes_[1].sentence, "no luck today");
    EXPECT_EQ(outcomes_[1].exit_status, 3);
    EXPECT_EQ(result.at("second"), TaskState::skipped);
    EXPECT_EQ(outcomes_[0].sentence, "needs \"first\", which failed");
    EXPECT_EQ(result.at("beside"), TaskState::done);
    EXPECT_FALSE(fs::exists(scratch_ / "first.txt")) << "half a result was left";
    // Tried again with the same input; put right, all of it is done.
    ran();
    run(tasks);
    EXPECT_EQ(ran(), "first");
    EXPECT_EQ(run(chain()).at("second"), TaskState::done);
}

TEST_F(RunTasks, TellsASignalAndAMissingOutput) {
    auto tasks = chain();
    tasks[1] = shell_task("first", "kill -SEGV $$", {"source"}, {"first.txt"});
    tasks[2] = shell_task("beside", "true", {"source"}, {"beside.txt"});
    run(tasks);
    EXPECT_EQ(outcomes_[1].sentence, "was ended by signal 11");
    EXPECT_EQ(outcomes_[2].sentence, "ended well without making beside.txt");
    tasks[1].inputs = {"nowhere"};
    EXPECT_EQ(run(tasks).at("first"), TaskState::failed);
    EXPECT_NE(outcomes_[1].sentence.find("nowhere: is not there"), std::string::npos);
}

TEST_F(RunTasks, LeavesOutWhatTheProgramLacks) {
    auto tasks = chain();
    tasks[1].missing = "there is no libtorch";
    const auto result = run(tasks);
    EXPECT_EQ(result.at("first"), TaskState::missing);
    EXPECT_EQ(outcomes_[1].sentence, "there is no libtorch");
    EXPECT_EQ(result.at("second"), TaskState::skipped);
    EXPECT_EQ(result.at("beside"), TaskState::done);
}

TEST_F(RunTasks, KeepsWhatATaskSaysOnlyIfItEndsWell) {
    Task said = shell_task("said", "echo text", {}, {});
    said.kept_output = "said/it.txt";
    EXPECT_EQ(run({said}).at("said"), TaskState::done);
    EXPECT_EQ(read_text(scratch_ / "said/it.txt"), "text\n");
    said.arguments[1] = "echo half; exit 1";
    EXPECT_EQ(run({said}).at("said"), TaskState::failed);
    EXPECT_FALSE(fs::exists(scratch_ / "said/it.txt"));
}

TEST_F(RunTasks, RemovesNothingThatIsNotItsOwn) {
    write_file(scratch_ / "second.txt", "mine");
    try {
        run(chain());
        ADD_FAILURE() << "took somebody's file for its own";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::refused);
        EXPECT_NE(std::string(e.what()).find("second.txt: is there already"), std::string::npos);
    }
    EXPECT_EQ(read_text(scratch_ / "second.txt"), "mine");
    EXPECT_EQ(ran(), "") << "something was run before it was refused";
}

TEST_F(RunTasks, RunsSideBySideWhatIsIndependentAndNoMoreThanFits) {
    // Each waits for the other's file: one after the other they would both give up.
    const auto meet = [](const std::string& a, const std::string& b) {
        return "touch here." + a + "; for i in $(seq 200); do [ -e here." + b + " ] && { touch " +
               a + ".out; exit 0; }; sleep 0.05; done; exit 1";
    };
    const std::vector<Task> two{shell_task("a", meet("a", "b"), {}, {"a.out"}),
                                shell_task("b", meet("b", "a"), {}, {"b.out"})};
    options_.cores = 2;
    const auto result = run(two);
    EXPECT_EQ(result.at("a"), TaskState::done);
    EXPECT_EQ(result.at("b"), TaskState::done);

    // On one core no two: each fails where another one runs.
    options_.cores = 1;
    std::vector<Task> alone;
    for (const char* id : {"x", "y", "z"})
        alone.push_back(shell_task(
            id, "mkdir busy || exit 1; sleep 0.1; rmdir busy; touch " + std::string(id), {}, {id}));
    for (const auto& [id, state] : run(alone)) EXPECT_EQ(state, TaskState::done) << id;
}

TEST_F(RunTasks, TellsEachTaskItsThreads) {
    options_.cores = 4;
    options_.threads_option = "--threads";
    std::vector<Task> tasks{shell_task("a", "echo $1 $2 > a.out", {}, {"a.out"}),
                            shell_task("b", "echo $1 $2 > b.out", {"a.out"}, {"b.out"}),
                            shell_task("c", "echo $1 $2 > c.out", {"a.out"}, {"c.out"})};
    tasks[2].most_threads = 1;
    tasks[2].cost = 100;  // first
    run(tasks);
    EXPECT_EQ(read_text(scratch_ / "a.out"), "--threads 4\n");
    EXPECT_EQ(read_text(scratch_ / "c.out"), "--threads 1\n");
    EXPECT_EQ(read_text(scratch_ / "b.out"), "--threads 3\n");
    // The number is not part of the work.
    options_.cores = 2;
    EXPECT_EQ(run(tasks).at("a"), TaskState::up_to_date);
}

TEST_F(RunTasks, EstimatesFromCostsAndThenFromWhatWasMeasured) {
    auto tasks = chain();
    for (Task& t : tasks) t.cost = 100;
    EXPECT_DOUBLE_EQ(estimate_tasks(TaskGraph(tasks), options_).seconds, 300);
    run(tasks);
    const WorkflowEstimate done = estimate_tasks(TaskGraph(tasks), options_);
    EXPECT_EQ(done.tasks, 0);
    EXPECT_EQ(done.seconds, 0);
    // A shell takes a thousandth of that, and so will the one that is not done.
    fs::remove(scratch_ / "beside.txt");
    const WorkflowEstimate one = estimate_tasks(TaskGraph(tasks), options_);
    EXPECT_EQ(one.tasks, 1);
    EXPECT_LT(one.seconds, 50);
}

}  // namespace
}  // namespace verdigris
