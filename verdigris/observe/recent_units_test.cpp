// SPDX-License-Identifier: MIT
#include "verdigris/observe/recent_units.h"

#include <gtest/gtest.h>

#include "verdigris/observe/testing/made_scene.h"
#include "verdigris/recording/memory_recording.h"

namespace verdigris {
namespace {

testing::MadeScene scene() {
    testing::MadeScene s;
    s.width = 160;
    s.height = 120;
    s.center_x = 75;
    s.center_y = 62;
    s.plate_width = 64;
    s.plate_height = 50;
    return s;
}

RecentUnits recent_of(int frames, double darkening = -1) {
    testing::MadeScene made = scene();
    if (darkening >= 0) made.darkening = darkening;
    std::vector<double> times;
    for (int i = 0; i < frames; ++i) times.push_back(2.0 * i);
    RecentUnits recent;
    const Inspection i =
        inspect(recording_from_function(made.width, made.height, times,
                                        [=](int n) { return made.frame(n, frames); }),
                recent);
    EXPECT_EQ(i.frames, frames);
    return recent;
}

double mean_red(const Image<SrgbF>& image, const Mask& inside) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < inside.pixels().size(); ++i)
        if (inside.pixels()[i] != 0) sum += double(image.pixels()[i].r), ++count;
    return sum / count;
}

TEST(RecentUnits, ThereIsOneFramePerUnitUpToTheLast) {
    for (const int frames : {12, 60, 100, 400}) {
        const RecentUnits r = recent_of(frames);
        ASSERT_EQ(r.frames.size(), std::size_t(std::min(frames, 20))) << frames;
        EXPECT_EQ(r.frames_recorded, frames);
        EXPECT_NEAR(r.units, frames < 148 ? frames : 98.4, 1e-9);
        EXPECT_NEAR(r.frames_per_unit, frames / r.units, 1e-9);
        for (const auto& frame : r.frames) {
            EXPECT_LE(std::max(frame.width(), frame.height()), kRecentSide);
            EXPECT_TRUE(r.specimen.same_size(frame));
        }
        // The plate darkens by the same in every unit, so that it does between these frames.
        const double all =
            mean_red(r.frames.front(), r.specimen) - mean_red(r.frames.back(), r.specimen);
        const std::size_t middle = r.frames.size() / 2;
        const double half =
            mean_red(r.frames.front(), r.specimen) - mean_red(r.frames[middle], r.specimen);
        EXPECT_GT(all, 0);
        EXPECT_NEAR(half / all, double(middle) / double(r.frames.size() - 1), 0.08) << frames;
    }
}

TEST(RecentUnits, AUnitWithoutAFrameIsFilledFromItsNeighbors) {
    testing::MadeScene made = scene();
    std::vector<double> times;
    for (int i = 0; i < 40; ++i)
        if (i != 30 && i != 34 && i != 35) times.push_back(2.0 * i);
    const auto frame_at = [&](int n) { return made.frame(int(times[std::size_t(n)]) / 2, 40); };
    RecentUnits recent;
    inspect(recording_from_function(made.width, made.height, times, frame_at), recent);
    ASSERT_GE(recent.frames.size(), 15u);
    // It darkens steadily, gaps or not: units are a little longer than frames, so by one or two.
    std::vector<double> red;
    for (const auto& frame : recent.frames) red.push_back(mean_red(frame, recent.specimen));
    const double pace = (red.front() - red.back()) / double(red.size() - 1);
    EXPECT_GT(pace, 0);
    for (std::size_t i = 1; i < red.size(); ++i) EXPECT_NEAR(red[i - 1] - red[i], pace, 1.1 * pace);
}

TEST(RecentUnits, OfAStillSceneNothingIsRead) {
    const RecentUnits r = recent_of(30, 0);
    EXPECT_TRUE(r.still);
    EXPECT_TRUE(r.frames.empty());
}

TEST(RecentUnits, OneFrameIsNoError) {
    EXPECT_TRUE(recent_of(1).frames.empty());
    EXPECT_EQ(recent_of(2).frames.size(), 2u);
}

}  // namespace
}  // namespace verdigris
