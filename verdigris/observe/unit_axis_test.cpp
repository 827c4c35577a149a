// SPDX-License-Identifier: MIT
#include "verdigris/observe/unit_axis.h"

#include <gtest/gtest.h>

#include <numeric>

#include "verdigris/error.h"

namespace verdigris {
namespace {

std::vector<double> even_times(int frames, double step) {
    std::vector<double> times;
    for (int i = 0; i < frames; ++i) times.push_back(i * step);
    return times;
}

TEST(UnitAxis, ThePapersRecordingsGetTheirGrid) {
    // 601 s at 60 fps: 984 samples of 36.6 frames, 6.1 s per unit.
    const AxisPlan chamber = plan_axis(even_times(36060, 1 / 60.0), std::nullopt);
    EXPECT_EQ(chamber.axis.samples, 984);
    EXPECT_EQ(chamber.axis.samples_per_unit, 10);
    EXPECT_DOUBLE_EQ(chamber.axis.units, 98.4);
    EXPECT_NEAR(chamber.axis.seconds_per_unit, 6.1, 0.05);
    // 482 s at 30 fps: 14.7 frames per sample, 4.9 s per unit.
    const AxisPlan air = plan_axis(even_times(14460, 1 / 30.0), std::nullopt);
    EXPECT_EQ(air.axis.samples, 984);
    EXPECT_NEAR(air.axis.seconds_per_unit, 4.9, 0.05);
    for (const int n : air.frames_in_bin) {
        EXPECT_GE(n, 14);
        EXPECT_LE(n, 15);
    }
}

TEST(UnitAxis, FewFramesAreOneSampleEach) {
    for (const int frames : {2, 41, 100, 147}) {
        const AxisPlan plan = plan_axis(even_times(frames, 288), std::nullopt);
        EXPECT_EQ(plan.axis.samples, frames);
        EXPECT_DOUBLE_EQ(plan.axis.units, frames);
        EXPECT_EQ(plan.axis.samples_per_unit, 1);
        EXPECT_TRUE(plan.one_frame_per_sample);
        for (int i = 0; i < frames; ++i) EXPECT_EQ(plan.bin_of_frame[std::size_t(i)], i);
    }
}

TEST(UnitAxis, BetweenFewAndManyTheStrideGrows) {
    EXPECT_EQ(plan_axis(even_times(148, 1), std::nullopt).axis.samples, 98);
    EXPECT_EQ(plan_axis(even_times(200, 1), std::nullopt).axis.samples, 197);
    EXPECT_EQ(plan_axis(even_times(983, 1), std::nullopt).axis.samples_per_unit, 9);
    EXPECT_EQ(plan_axis(even_times(984, 1), std::nullopt).axis.samples, 984);
    EXPECT_EQ(plan_axis(even_times(984, 1), std::nullopt).axis.samples_per_unit, 10);
}

TEST(UnitAxis, GivenUnitsAreKept) {
    const AxisPlan plan = plan_axis(even_times(100, 1), 33.0);
    EXPECT_DOUBLE_EQ(plan.axis.units, 33);
    EXPECT_EQ(plan.axis.samples_per_unit, 3);
    EXPECT_EQ(plan.axis.samples, 99);
    EXPECT_EQ(std::accumulate(plan.frames_in_bin.begin(), plan.frames_in_bin.end(), 0), 100);
    EXPECT_THROW(plan_axis(even_times(100, 1), 0.0), Error);
    EXPECT_THROW(plan_axis(even_times(100, 1), -3.0), Error);
    EXPECT_THROW(plan_axis(even_times(100, 1), 101.0), Error);
}

TEST(UnitAxis, RoundedStampsAreRegularAndGapsAreNot) {
    std::vector<double> rounded;  // 30 fps in whole milliseconds
    for (int i = 0; i < 100; ++i) rounded.push_back(double(int(i * 1000.0 / 30 + 0.5)) / 1000);
    EXPECT_TRUE(plan_axis(rounded, std::nullopt).one_frame_per_sample);

    std::vector<double> gap = even_times(50, 1);
    for (int i = 25; i < 50; ++i) gap[std::size_t(i)] += 10;
    const AxisPlan plan = plan_axis(gap, std::nullopt);
    EXPECT_FALSE(plan.one_frame_per_sample);
    EXPECT_EQ(plan.axis.samples, 50);
    EXPECT_GT(std::count(plan.frames_in_bin.begin(), plan.frames_in_bin.end(), 0), 0);
    ASSERT_EQ(plan.notes.size(), 1u);
    EXPECT_EQ(plan.notes[0].id, "irregular_times");
}

TEST(UnitAxis, EqualStampsFallBackToTheOrder) {
    const AxisPlan plan = plan_axis(std::vector<double>(40, 7.0), std::nullopt);
    EXPECT_TRUE(plan.one_frame_per_sample);
    ASSERT_EQ(plan.notes.size(), 1u);
    EXPECT_EQ(plan.notes[0].id, "times_equal");
}

TEST(UnitAxis, KeptSamplesCountBackFromTheLast) {
    UnitAxis axis{98.4, 984, 10, 6.1};
    const std::vector<bool> kept = kept_samples(axis, Keep::unit_steps);
    EXPECT_EQ(std::count(kept.begin(), kept.end(), true), 99);
    EXPECT_TRUE(kept[983]);
    EXPECT_TRUE(kept[3]);
    EXPECT_FALSE(kept[4]);
    const std::vector<bool> all = kept_samples(axis, Keep::every_sample);
    EXPECT_EQ(std::count(all.begin(), all.end(), true), 984);
}

TEST(UnitAxis, ThePaperKeeps950Of984) {
    EXPECT_EQ(paper_valid_range(984), (std::pair<int, int>{17, 967}));
    EXPECT_EQ(paper_valid_range(10), (std::pair<int, int>{0, 10}));
}

TEST(UnitAxis, TruncationKeepsTheUnit) {
    const UnitAxis cut = truncated({98.4, 984, 10, 6.1}, 410);
    EXPECT_EQ(cut.samples, 410);
    EXPECT_NEAR(cut.units, 41, 1e-9);
    EXPECT_DOUBLE_EQ(cut.seconds_per_unit, 6.1);
}

}  // namespace
}  // namespace verdigris
