// SPDX-License-Identifier: MIT
#include "verdigris/reproduce/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "verdigris/workflow/task_graph.h"

namespace verdigris {
namespace {

std::set<std::string> kinds(const std::vector<Task>& tasks) {
    std::set<std::string> set;
    for (const Task& t : tasks) set.insert(t.kind);
    return set;
}

const Task& of(const std::vector<Task>& tasks, const std::string& id) {
    const auto found = std::ranges::find(tasks, id, &Task::id);
    if (found == tasks.end()) throw std::runtime_error("no task " + id);
    return *found;
}

TEST(Plan, HoldsEveryTableAndFigureOfThePaper) {
    const auto tasks = reproduction_tasks({});
    EXPECT_NO_THROW(TaskGraph{tasks});
    EXPECT_EQ(kinds(tasks),
              (std::set<std::string>{"simulate", "evaluate", "characterize", "drift", "train",
                                     "susceptibility", "judge-materials", "audit"}));
    EXPECT_EQ(std::ranges::count(tasks, "train", &Task::kind), 8) << "four networks, both ways";
    EXPECT_EQ(std::ranges::count(tasks, "audit", &Task::kind), 5);
    for (const Task& t : tasks) EXPECT_EQ(t.missing, "") << t.id;
    // Each network is judged by itself: one that fails takes only its own rows along.
    const TaskGraph graph(tasks);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        if (tasks[i].id != "evaluate-convlstm") continue;
        for (const std::size_t need : graph.needs(i))
            EXPECT_TRUE(tasks[need].kind == "simulate" ||
                        tasks[need].id.starts_with("train-convlstm"))
                << tasks[need].id;
    }
}

TEST(Plan, TakesRecordingsAndCopperThatAreGiven) {
    ReproductionOptions options;
    options.recordings = {"/data/one.mp4", "/data/two photos"};
    options.copper = "/data/copper";
    const auto tasks = reproduction_tasks(options);
    EXPECT_FALSE(kinds(tasks).contains("simulate"));
    EXPECT_EQ(of(tasks, "evaluate").inputs,
              (std::vector<std::filesystem::path>{"/data/one.mp4", "/data/two photos"}));
    EXPECT_EQ(command_text(of(tasks, "drift")),
              "verdigris drift /data/one.mp4 '/data/two photos' -o drift");
    for (const char* id : {"copper", "copper-10", "copper-characterize", "audit-copper"})
        EXPECT_NO_THROW(of(tasks, id));
}

TEST(Plan, SaysWhatABuildLacks) {
    ReproductionOptions options;
    options.no_networks = "no libtorch";
    const auto tasks = reproduction_tasks(options);
    for (const Task& t : tasks) {
        const bool network = t.kind == "train" || t.kind == "susceptibility" ||
                             t.id.find("-patinanet") != std::string::npos ||
                             t.id.find("-convlstm") != std::string::npos ||
                             t.id.find("-predformer") != std::string::npos ||
                             t.id.find("-horizonnet") != std::string::npos;
        EXPECT_EQ(t.missing, network ? "no libtorch" : "") << t.id;
    }
    EXPECT_EQ(command_text(of(tasks, "materials")).find("safetensors"), std::string::npos);
}

TEST(Plan, QuickIsALotLess) {
    ReproductionOptions options;
    double whole = 0, quick = 0;
    for (const Task& t : reproduction_tasks(options)) whole += t.cost;
    options.quick = true;
    for (const Task& t : reproduction_tasks(options)) quick += t.cost;
    EXPECT_LT(quick, 600) << "ten minutes on one core, and it has two";
    EXPECT_GT(whole, 20 * quick);
    EXPECT_EQ(trained_networks(options).size(), 1u);
}

TEST(Plan, QuotesForAShell) {
    Task task;
    task.arguments = {"evaluate", "a b", "it's", "x,y=1.mkv", ""};
    EXPECT_EQ(command_text(task), "verdigris evaluate 'a b' 'it'\\''s' x,y=1.mkv ''");
}

}  // namespace
}  // namespace verdigris
