// SPDX-License-Identifier: MIT
// The counts that [Paper] prints, and what a protocol refuses. See docs/PROTOCOL.md.
#include "verdigris/evaluate/protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "verdigris/error.h"
#include "verdigris/evaluate/windows.h"

namespace verdigris {
namespace {

TEST(Protocol, GivesTheCountsThePaperPrints) {
    const EvaluationProtocol paper;
    const WindowPlan plan = plan_windows(paper, 984);
    EXPECT_EQ(paper.span(), 140);
    EXPECT_EQ(plan.usable.count(), 950);
    EXPECT_EQ(plan.all_starts, 810);
    EXPECT_EQ(plan.starts.size(), 810u);
    EXPECT_EQ(plan.independent, 6);
    ASSERT_TRUE(plan.splits);
    EXPECT_EQ(plan.splits->train.count(), 492);
    EXPECT_EQ(plan.splits->embargo.count(), 140);
    EXPECT_EQ(plan.splits->validation.count(), 246);
    EXPECT_EQ(plan.splits->unused.count(), 72);
    EXPECT_EQ(windows_inside(plan.splits->train, plan.span), 352);
    EXPECT_EQ(windows_inside(plan.splits->validation, plan.span), 106);
}

TEST(Protocol, TheGridExplainsTheSecondsPerUnit) {
    // 601 s and 482 s at 984 samples and 10 per unit print as 6.1 and 4.9; 950 or 1000 do not.
    const auto tenths = [](double seconds, int grid) {
        return int(seconds * 10 / grid * 10 + 0.5);  // seconds per unit, rounded to tenths
    };
    EXPECT_EQ(tenths(601, 984), 61);
    EXPECT_EQ(tenths(482, 984), 49);
    EXPECT_NE(tenths(601, 950), 61);
    EXPECT_NE(tenths(601, 1000), 61);
}

TEST(Protocol, LongHorizonsReachEightyFive) {
    EvaluationProtocol ten;
    ten.context = 10;
    ten.horizons = 85;  // the furthest a context of ten leaves room for
    ten.embargo = 0;
    EXPECT_NO_THROW(plan_windows(ten, 984));
    ten.horizons = 86;
    EXPECT_THROW(plan_windows(ten, 984), Error);
    ten.context = 5;
    ten.horizons = 85;
    EXPECT_EQ(plan_windows(ten, 984).all_starts, 60);  // the sweep's 60 windows
    EvaluationProtocol sweep;
    sweep.context = 10;
    EXPECT_EQ(plan_windows(sweep, 984).all_starts, 760);
}

TEST(Protocol, SplitsFollowOneAnother) {
    const WindowPlan plan = plan_windows({}, 984);
    EXPECT_EQ(plan.usable, (SampleRange{17, 967}));
    EXPECT_EQ(plan.splits->train.begin, plan.usable.begin);
    EXPECT_EQ(plan.splits->embargo.begin, plan.splits->train.end);
    EXPECT_EQ(plan.splits->validation.begin, plan.splits->embargo.end);
    EXPECT_EQ(plan.splits->unused.end, plan.usable.end);
}

TEST(Protocol, WindowsStayInsideAndReachTheEnd) {
    const EvaluationProtocol paper;
    const WindowPlan plan = plan_windows(paper, 984);
    EXPECT_EQ(plan.starts.front(), 17);
    const std::vector<int> last = window_samples(paper, plan.starts.back());
    EXPECT_EQ(last.size(), 15u);
    EXPECT_EQ(last.back(), 966);  // the last usable sample is a target: no off-by-one
}

TEST(Protocol, ASweepTakesEvenlySpacedWindows) {
    EvaluationProtocol sweep;
    sweep.max_windows = 60;
    const WindowPlan plan = plan_windows(sweep, 984);
    EXPECT_EQ(plan.starts.size(), 60u);
    EXPECT_EQ(plan.starts.front(), 17);
    EXPECT_EQ(plan.starts.back(), 17 + 809);
    EXPECT_EQ(std::set<int>(plan.starts.begin(), plan.starts.end()).size(), 60u);
    sweep.max_windows = 5000;
    EXPECT_EQ(plan_windows(sweep, 984).starts.size(), 810u);
    sweep.max_windows = 1;
    EXPECT_EQ(plan_windows(sweep, 984).starts, std::vector<int>{17});
}

TEST(Protocol, TakesAHundredPhotographs) {
    const WindowPlan plan = plan_windows(short_recording_protocol(), 100);
    EXPECT_EQ(plan.span, 42);
    EXPECT_EQ(plan.all_starts, 58);
    EXPECT_EQ(plan.independent, 2);
    EXPECT_FALSE(plan.splits);  // nothing can be trained on so few, and it says so
    EXPECT_NE(plan.splits_problem.find("do not fit"), std::string::npos);
}

void expect_refusal(const std::function<void(EvaluationProtocol&)>& change,
                    const std::string& word) {
    EvaluationProtocol protocol;
    change(protocol);
    try {
        check_protocol(protocol);
        ADD_FAILURE() << "accepted: " << word;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(error.sentence().find(word), std::string::npos) << error.sentence();
    }
}

TEST(Protocol, RefusesWhatMakesNoSenseAndNamesTheOption) {
    expect_refusal([](auto& p) { p.stride = 0; }, "stride");
    expect_refusal([](auto& p) { p.context = 0; }, "context");
    expect_refusal([](auto& p) { p.horizons = -1; }, "horizons");
    expect_refusal([](auto& p) { p.trim_lead = -1; }, "trim_lead");
    expect_refusal([](auto& p) { p.min_foreground = 0; }, "min_foreground");
    expect_refusal([](auto& p) { p.tau = -0.1; }, "tau");
    expect_refusal([](auto& p) { p.tau = std::nan(""); }, "tau");
    expect_refusal([](auto& p) { p.train_fraction = 1.5; }, "train_fraction");
    expect_refusal([](auto& p) { p.bootstrap_draws = 5; }, "bootstrap_draws");
    expect_refusal([](auto& p) { p.train_fraction = 0.8; }, "splits overlap");
    expect_refusal([](auto& p) { p.embargo = 300; }, "splits overlap");
    expect_refusal([](auto& p) { p.embargo = -5; }, "embargo");
    expect_refusal([](auto& p) { p.grid = 100; }, "one window spans");
}

TEST(Protocol, NamesTheRecordingThatDoesNotFit) {
    try {
        plan_windows({}, 500, "air.mp4");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_EQ(error.where(), "air.mp4");
        EXPECT_NE(error.sentence().find("984"), std::string::npos);
    }
    try {
        plan_windows(short_recording_protocol(), 42, "short.mp4");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(error.sentence().find("too short"), std::string::npos);
    }
    EXPECT_EQ(plan_windows(short_recording_protocol(), 43).all_starts, 1);
}

}  // namespace
}  // namespace verdigris
