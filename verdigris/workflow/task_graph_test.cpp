// SPDX-License-Identifier: MIT
#include "verdigris/workflow/task_graph.h"

#include <gtest/gtest.h>

#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

Task task(const std::string& id, std::vector<std::filesystem::path> inputs, double cost = 1) {
    Task t;
    t.id = t.title = id;
    t.inputs = std::move(inputs);
    t.outputs = {id + ".out"};
    t.cost = cost;
    return t;
}

std::string order(const TaskGraph& graph) {
    std::string text;
    for (const std::size_t i : graph.order()) text += graph.tasks()[i].id;
    return text;
}

std::string why_not(std::vector<Task> tasks) {
    try {
        TaskGraph graph(std::move(tasks));
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::usage);
        return e.what();
    }
    return {};
}

TEST(TaskGraph, PutsEveryTaskBehindWhatItNeeds) {
    const TaskGraph graph({task("d", {"b.out", "c.out/inside/it"}), task("b", {"./a.out"}),
                           task("c", {"a.out", "elsewhere"}), task("a", {})});
    EXPECT_EQ(order(graph), "abcd");
    EXPECT_EQ(graph.needs(0), (std::vector<std::size_t>{1, 2}));
    EXPECT_TRUE(graph.needs(3).empty());
}

TEST(TaskGraph, AlsoBehindWhatItIsToldToWaitFor) {
    Task late = task("a", {});
    late.after = {"b"};
    EXPECT_EQ(order(TaskGraph({late, task("b", {})})), "ba");
}

TEST(TaskGraph, RefusesWhatCannotBeDone) {
    EXPECT_NE(why_not({task("a", {"b.out"}), task("b", {"a.out"})}).find("circle"),
              std::string::npos);
    EXPECT_NE(why_not({task("a", {"a.out"})}).find("circle"), std::string::npos);
    EXPECT_NE(why_not({task("a", {}), task("a", {})}).find("two of this id"), std::string::npos);
    EXPECT_NE(why_not({task("../a", {})}).find("no id"), std::string::npos);
    Task lost = task("a", {});
    lost.after = {"z"};
    EXPECT_NE(why_not({lost}).find("'z'"), std::string::npos);
    Task inside = task("b", {});
    inside.outputs = {"a.out/more"};
    EXPECT_NE(why_not({task("a", {}), inside}).find("which a makes too"), std::string::npos);
    Task idle = task("a", {});
    idle.outputs.clear();
    EXPECT_NE(why_not({idle}).find("makes nothing"), std::string::npos);
    // A name that only begins alike is another.
    Task alike = task("b", {});
    alike.outputs = {"a.out2"};
    EXPECT_EQ(why_not({task("a", {}), alike}), "");
}

TEST(TaskGraph, KnowsTheLongestWayToAnEnd) {
    const TaskGraph graph({task("a", {}, 1), task("b", {"a.out"}, 2), task("c", {"a.out"}, 5),
                           task("d", {"b.out"}, 10)});
    EXPECT_EQ(graph.costs_to_end(), (std::vector<double>{13, 12, 5, 10}));
    EXPECT_EQ(graph.costs_to_end({{"", 2}}), (std::vector<double>{26, 24, 10, 20}));
}

TEST(EstimatedSeconds, OfKnownSchedules) {
    // One core: the sum. Two: a (2 threads, 4 s), then c (8 s) beside b (3 s), which then ends.
    Task a = task("a", {}, 8), b = task("b", {"a.out"}, 3), c = task("c", {"a.out"}, 8);
    b.most_threads = c.most_threads = 1;
    const TaskGraph graph({a, b, c});
    const std::vector<double> cost{8, 3, 8};
    const std::vector<bool> all{true, true, true};
    EXPECT_DOUBLE_EQ(estimated_seconds(graph, cost, all, 1), 19);
    EXPECT_DOUBLE_EQ(estimated_seconds(graph, cost, all, 2), 12);
    EXPECT_DOUBLE_EQ(estimated_seconds(graph, cost, {false, true, false}, 2), 3);
    EXPECT_DOUBLE_EQ(estimated_seconds(graph, cost, {false, false, false}, 2), 0);
}

TEST(ThreadsFor, SharesWhatIsFree) {
    Task t = task("a", {});
    EXPECT_EQ(threads_for(t, 4, 0), 4);
    EXPECT_EQ(threads_for(t, 4, 1), 2);
    EXPECT_EQ(threads_for(t, 2, 7), 1);
    t.most_threads = 1;
    EXPECT_EQ(threads_for(t, 4, 0), 1);
}

}  // namespace
}  // namespace verdigris
