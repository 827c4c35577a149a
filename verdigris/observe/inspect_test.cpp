// SPDX-License-Identifier: MIT
#include "verdigris/observe/inspect.h"

#include <gtest/gtest.h>

#include "verdigris/error.h"
#include "verdigris/observe/testing/made_scene.h"
#include "verdigris/recording/memory_recording.h"

namespace verdigris {
namespace {

using testing::MadeScene;

Inspection inspect_made(const MadeScene& scene, int frames) {
    std::vector<double> times;
    for (int i = 0; i < frames; ++i) times.push_back(2.0 * i);
    return inspect(recording_from_function(scene.width, scene.height, times,
                                           [=](int i) { return scene.frame(i, frames); }));
}
MadeScene small_scene() {
    MadeScene scene;
    scene.width = 160;
    scene.height = 120;
    scene.center_x = 75;
    scene.center_y = 62;
    scene.plate_width = 64;
    scene.plate_height = 50;
    return scene;
}
bool has(const Inspection& i, const std::string& id) {
    return std::any_of(i.findings.begin(), i.findings.end(),
                       [&](const Status& s) { return s.id == id; });
}

TEST(Inspect, ASteadyRecordingIsGood) {
    const Inspection i = inspect_made(small_scene(), 100);
    EXPECT_EQ(i.verdict, Verdict::good) << i.verdict_sentence;
    EXPECT_EQ(i.frames, 100);
    EXPECT_DOUBLE_EQ(i.duration_seconds, 198);
    EXPECT_DOUBLE_EQ(i.median_step_seconds, 2);
    EXPECT_DOUBLE_EQ(i.longest_step_seconds, 2);
    EXPECT_DOUBLE_EQ(i.units, 100);
    EXPECT_EQ(i.samples_per_unit, 1);
    EXPECT_NEAR(i.noise_sigma, std::sqrt(4 + 1 / 12.0) / 255, 6e-4);
    // 35 % of the mean plate color, a little less in blue.
    EXPECT_NEAR(i.specimen_change, 0.15, 0.04);
    EXPECT_LT(i.exposure_drift, 0.005);
    EXPECT_EQ(i.crop.width, i.crop.height);
    EXPECT_EQ(i.clipped_share, 0);
    EXPECT_LT(i.largest_jump, 4);
}

TEST(Inspect, AJumpIsNamed) {
    const MadeScene scene = small_scene();
    std::vector<double> times;
    for (int i = 0; i < 40; ++i) times.push_back(i);
    const Inspection i = inspect(recording_from_function(160, 120, times, [&](int n) {
        Image<SrgbU8> frame = scene.frame(n, 40);
        if (n >= 31) {
            for (auto& c : frame.pixels()) {
                c = {std::uint8_t(c.r * 0.7), std::uint8_t(c.g * 0.7), std::uint8_t(c.b * 0.7)};
            }
        }
        return frame;
    }));
    EXPECT_EQ(i.largest_jump_frame, 31);
    EXPECT_TRUE(has(i, "jump"));
    EXPECT_NEAR(i.exposure_drift, 0.3, 0.01);
    EXPECT_EQ(i.verdict, Verdict::poor);
    EXPECT_NE(i.verdict_sentence.find("frame 31"), std::string::npos) << i.verdict_sentence;
}

TEST(Inspect, WhatIsWrongIsSaid) {
    MadeScene still = small_scene();
    still.darkening = 0;
    EXPECT_EQ(inspect_made(still, 30).verdict, Verdict::poor);
    EXPECT_TRUE(has(inspect_made(still, 30), "still_scene"));

    MadeScene noisy = small_scene();
    noisy.noise = 10.0 / 255;
    EXPECT_TRUE(has(inspect_made(noisy, 30), "noisy"));

    MadeScene tiny = small_scene();
    tiny.plate_width = tiny.plate_height = 17;
    const Inspection unclear = inspect_made(tiny, 30);
    EXPECT_TRUE(has(unclear, "specimen_unclear"));
    EXPECT_NE(unclear.crop_sentence.find("--crop"), std::string::npos);

    EXPECT_EQ(inspect_made(small_scene(), 1).verdict, Verdict::unusable);
    EXPECT_TRUE(has(inspect_made(small_scene(), 3), "few_frames"));
    EXPECT_EQ(inspect_made(small_scene(), 3).verdict, Verdict::poor);
}

TEST(Inspect, VerdictsHaveNames) {
    EXPECT_EQ(to_string(Verdict::good), "good");
    EXPECT_EQ(to_string(Verdict::unusable), "unusable");
}

TEST(Inspect, StopsWhenAsked) {
    std::vector<double> times{0, 1, 2, 3};
    const Recording recording =
        recording_from_function(160, 120, times, [](int i) { return small_scene().frame(i, 4); });
    EXPECT_THROW(inspect(recording, [](auto, auto done, auto) { return done < 2; }), Error);
}

}  // namespace
}  // namespace verdigris
