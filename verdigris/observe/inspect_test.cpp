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

Inspection inspect_at(const std::vector<double>& times) {
    const MadeScene scene = small_scene();
    const int frames = int(times.size());
    return inspect(recording_from_function(scene.width, scene.height, times,
                                           [=](int i) { return scene.frame(i, frames); }));
}

TEST(Inspect, TimesThatRepeatAndGapsAreCautions) {
    std::vector<double> times;
    for (int i = 0; i < 40; ++i) times.push_back(i);
    EXPECT_FALSE(has(inspect_at(times), "times_repeat"));
    times[10] = times[9];
    const Inspection one = inspect_at(times);
    EXPECT_TRUE(has(one, "times_repeat"));
    EXPECT_EQ(one.verdict, Verdict::usable) << one.verdict_sentence;
    EXPECT_NE(one.verdict_sentence.find("1 of 40 frames carries the same time"), std::string::npos)
        << one.verdict_sentence;
    for (int i = 20; i < 40; ++i) times[std::size_t(i)] += 12;
    const Inspection both = inspect_at(times);
    EXPECT_TRUE(has(both, "gap_in_time"));
    EXPECT_EQ(both.verdict, Verdict::poor);
    for (const Status& s : both.findings) {
        if (s.id == "gap_in_time" || s.id == "times_repeat") {
            EXPECT_EQ(s.severity, Severity::caution);
        }
    }
    // Every frame at one time is said once, in the axis' words.
    const Inspection stopped = inspect_at(std::vector<double>(30, 5.0));
    EXPECT_TRUE(has(stopped, "times_equal"));
    EXPECT_FALSE(has(stopped, "times_repeat"));
}

TEST(Inspect, TheVerdictBeginsWithWhatMattersMost) {
    MadeScene scene = small_scene();
    scene.illumination_drift = 0.15;
    std::vector<double> times;
    for (int i = 0; i < 12; ++i) times.push_back(i < 6 ? i : i + 20);
    const Inspection i = inspect(recording_from_function(
        scene.width, scene.height, times, [=](int n) { return scene.frame(n, 12); }));
    EXPECT_TRUE(has(i, "few_frames"));
    EXPECT_TRUE(has(i, "gap_in_time"));
    ASSERT_FALSE(i.findings.empty());
    EXPECT_EQ(i.findings.front().id, "exposure_drift") << i.verdict_sentence;
    EXPECT_NE(i.verdict_sentence.find("the weightiest: the backdrop moves with the specimen"),
              std::string::npos)
        << i.verdict_sentence;
}

TEST(Inspect, WithoutABackdropTheDriftIsUnknown) {
    MadeScene scene = small_scene();
    EXPECT_TRUE(inspect_made(scene, 60).drift_known);
    scene.plate_width = scene.plate_height = 2000;
    const Inspection i = inspect_made(scene, 60);
    EXPECT_FALSE(i.drift_known);
    EXPECT_TRUE(has(i, "light_unknown"));
    EXPECT_EQ(i.verdict, Verdict::good) << i.verdict_sentence;
    EXPECT_EQ(i.verdict_sentence.find("steady light"), std::string::npos) << i.verdict_sentence;
}

TEST(Inspect, LightThatRampsIsCalledLight) {
    MadeScene scene = small_scene();
    const auto ramp = [&](double darkening) {
        scene.darkening = darkening;
        std::vector<double> times;
        for (int i = 0; i < 60; ++i) times.push_back(i);
        return inspect(recording_from_function(160, 120, times, [=](int n) {
            Image<SrgbU8> frame = scene.frame(n, 60);
            const double gain = 1 + 0.2 * n / 59;
            for (auto& c : frame.pixels()) {
                c = {std::uint8_t(std::min(255.0, c.r * gain)),
                     std::uint8_t(std::min(255.0, c.g * gain)),
                     std::uint8_t(std::min(255.0, c.b * gain))};
            }
            return frame;
        }));
    };
    const auto sentence = [](const Inspection& i) {
        for (const Status& s : i.findings) {
            if (s.id == "exposure_drift") return s.sentence;
        }
        return std::string();
    };
    const std::string aging = sentence(ramp(0.35));
    EXPECT_NE(aging.find("the backdrop moves with the specimen, it gets up to"), std::string::npos)
        << aging;
    EXPECT_NE(aging.find("brighter"), std::string::npos) << aging;
    const std::string alone = sentence(ramp(0));
    EXPECT_NE(alone.find("backdrop included"), std::string::npos) << alone;
    EXPECT_NE(alone.find("not the copper"), std::string::npos) << alone;
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
