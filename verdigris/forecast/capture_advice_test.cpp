// SPDX-License-Identifier: MIT
#include "verdigris/forecast/capture_advice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "verdigris/color/convert.h"
#include "verdigris/forecast/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kWidth = 64, kHeight = 48;

/// A frame of a made recording; what is `inside` is specimen.
using Frame = std::function<SrgbF(int frame, int x, int y)>;

RecentUnits recorded(int n, const Frame& color, double noise = 0, bool backdrop = true) {
    std::mt19937 random(7);
    RecentUnits recent;
    for (int t = 0; t < n; ++t) {
        recent.frames.push_back(
            paint(kWidth, kHeight, [&](int x, int y) { return color(t, x, y); }));
        if (noise > 0) add_noise(recent.frames.back(), noise, random);
    }
    recent.specimen = Mask(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            recent.specimen(x, y) = !backdrop || (x >= 12 && x < 52) ? 255 : 0;
    recent.frames_recorded = n;
    recent.units = n;
    recent.frames_per_unit = 1;
    recent.seconds_per_unit = 60;
    return recent;
}

bool on_plate(int x) {
    return x >= 12 && x < 52;
}

SrgbF plus(SrgbF c, double by) {
    return {c.r + float(by), c.g + float(by) / 2, c.b - float(by) / 2};
}

/// A field of smooth lumps that goes by its own way in each frame: steps of standard deviation
/// `size(t)` in each lump.
RecentUnits wandering(int n, const std::function<double(int)>& size, double noise = 0.001) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    std::vector<std::array<double, 16>> level(std::size_t(n), std::array<double, 16>{});
    for (int t = 1; t < n; ++t)
        for (std::size_t i = 0; i < 16; ++i)
            level[std::size_t(t)][i] = level[std::size_t(t) - 1][i] + size(t) * normal(random);
    return recorded(
        n,
        [&](int t, int x, int y) {
            const SrgbF c = texture(x, y);
            const auto lump = std::size_t((x - 12) / 10 + 4 * (y / 12));
            return on_plate(x) ? plus(c, level[std::size_t(t)][lump]) : c;
        },
        noise);
}

void expect_sound(const CaptureAdvice& a) {
    EXPECT_FALSE(a.id.empty());
    EXPECT_FALSE(a.sentence.empty());
    EXPECT_EQ(a.sentence.find("nan"), std::string::npos) << a.sentence;
    EXPECT_EQ(a.sentence.find("inf"), std::string::npos) << a.sentence;
    double last = a.error * (1 + 1e-9);
    for (const CaptureOutlook& o : a.outlooks) {
        EXPECT_LE(o.error, last) << a.sentence;
        last = o.error * (1 + 1e-9);
    }
    for (const double share : {a.noise_share, a.light_share, a.unforeseen_share}) {
        EXPECT_GE(share, 0);
        EXPECT_LE(share, 1);
    }
}

bool says(const CaptureAdvice& a, const char* words) {
    return a.sentence.find(words) != std::string::npos;
}

TEST(CaptureAdvice, ChangeThatNothingForetellsIsNotHalved) {
    const CaptureAdvice a = capture_advice(wandering(20, [](int) { return 0.01; }));
    expect_sound(a);
    EXPECT_EQ(a.id, "unforeseen") << a.sentence;
    EXPECT_FALSE(a.halved) << a.sentence;
    EXPECT_GT(a.unforeseen_share, 0.7);
    EXPECT_LT(a.noise_share, 0.1);
    EXPECT_TRUE(says(a, "no past frame foretells")) << a.sentence;
    // Steps of 0.01 in red, half of that in green and blue: over one to ten of them.
    EXPECT_NEAR(a.error, 0.01 * std::sqrt(5.5 * 1.5 / 3), 0.006);
}

TEST(CaptureAdvice, ChangeThatDiesAwayIsHalvedByWaiting) {
    const CaptureAdvice a =
        capture_advice(wandering(20, [](int t) { return 0.06 * std::exp(-0.1 * t); }));
    expect_sound(a);
    ASSERT_EQ(a.id, "record_on") << a.sentence;
    // exp(-0.1 m) is a half at 7; as known as the steps are few, to a factor of two.
    EXPECT_GE(a.halved->units, 5);
    EXPECT_LE(a.halved->units, 15);
    EXPECT_EQ(a.halved->frames, a.halved->units);
    EXPECT_LE(a.halved->error, a.error / 2);
    EXPECT_TRUE(says(a, "more frames")) << a.sentence;
    EXPECT_TRUE(says(a, "minutes by the recording's own clock")) << a.sentence;
}

TEST(CaptureAdvice, FramesAndTimeAreThoseOfTheRecording) {
    RecentUnits recent = wandering(20, [](int t) { return 0.06 * std::exp(-0.1 * t); });
    const CaptureAdvice one = capture_advice(recent);
    recent.frames_per_unit = 30;
    const CaptureAdvice thirty = capture_advice(recent);
    ASSERT_TRUE(one.halved && thirty.halved);
    EXPECT_EQ(thirty.halved->frames, 30 * one.halved->frames);
    recent.seconds_per_unit = 0;
    EXPECT_FALSE(says(capture_advice(recent), "clock"));
}

TEST(CaptureAdvice, LightThatJittersIsSaidToBeTheTrouble) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    std::vector<float> gain;
    for (int t = 0; t < 16; ++t) gain.push_back(1 + 0.06f * normal(random));
    const auto color = [&](int t, int x, int y) {
        const SrgbF c = texture(x, y);
        const auto lit = [&](float v) {
            return srgb_from_linear(linear_from_srgb(v) * gain[std::size_t(t)]);
        };
        const SrgbF l{lit(c.r), lit(c.g), lit(c.b)};
        return on_plate(x) ? plus(l, 0.002 * t) : l;
    };
    const CaptureAdvice a = capture_advice(recorded(16, color, 0.001));
    expect_sound(a);
    EXPECT_EQ(a.id, "light") << a.sentence;
    EXPECT_GT(a.light_share, 0.5);
    EXPECT_TRUE(says(a, "lamp")) << a.sentence;
    // Nothing but copper in view: the way to know is to show what is none.
    const CaptureAdvice close = capture_advice(recorded(16, color, 0.001, false));
    expect_sound(close);
    EXPECT_FALSE(close.backdrop);
    EXPECT_TRUE(says(close, "backdrop")) << close.sentence;
}

TEST(CaptureAdvice, NoiseIsAveragedByMorePhotographs) {
    const auto drifting = [](int t, int x, int y) {
        const SrgbF c = texture(x, y);
        return on_plate(x) ? plus(c, 0.002 * t * std::sin(0.3 * x) * std::cos(0.4 * y)) : c;
    };
    const CaptureAdvice noisy = capture_advice(recorded(8, drifting, 0.05));
    expect_sound(noisy);
    EXPECT_GT(noisy.noise_share, 0.3) << noisy.sentence;
    EXPECT_TRUE(says(noisy, "photographs per unit")) << noisy.sentence;
    // A forecast that averages sixteen of them has less of it.
    RecentUnits many = recorded(8, drifting, 0.05);
    many.frames_per_sample = 16;
    EXPECT_LT(capture_advice(many).error, 0.8 * noisy.error);
}

TEST(CaptureAdvice, WhateverIsRecordedThereIsASentence) {
    const auto flat = [](int, int x, int y) { return texture(x, y); };
    EXPECT_EQ(capture_advice({}).id, "too_few");
    EXPECT_EQ(capture_advice(recorded(2, flat)).id, "too_few");
    EXPECT_EQ(capture_advice(recorded(4, flat, 0.01)).id, "too_few");
    EXPECT_EQ(capture_advice(recorded(12, flat)).id, "still");
    EXPECT_EQ(capture_advice(recorded(12, [](int, int, int) { return SrgbF{}; })).id, "still");
    RecentUnits still;
    still.still = true;
    EXPECT_EQ(capture_advice(still).id, "still");
    RecentUnits no_specimen = recorded(12, flat, 0.01);
    for (auto& m : no_specimen.specimen.pixels()) m = 0;
    EXPECT_EQ(capture_advice(no_specimen).id, "still");
    // Pure noise: its level is all there is to know, and nearly is.
    const CaptureAdvice noise = capture_advice(recorded(30, flat, 0.02));
    expect_sound(noise);
    EXPECT_LT(noise.error, 0.01) << noise.sentence;
    // The light is switched half-way, on a still plate and on one that changes.
    for (const double pace : {0.0, 0.004}) {
        const CaptureAdvice switched = capture_advice(recorded(
            20,
            [&](int t, int x, int y) {
                SrgbF c = texture(x, y);
                if (on_plate(x)) c = plus(c, pace * t);
                return t < 10 ? c : SrgbF{c.r * 0.8f, c.g * 0.8f, c.b * 0.8f};
            },
            0.002));
        expect_sound(switched);
        EXPECT_LT(switched.error, 0.1) << switched.sentence;
    }
}

TEST(CaptureAdvice, TheSameOnAnyNumberOfThreads) {
    const RecentUnits recent = wandering(12, [](int) { return 0.01; });
    set_thread_count(1);
    const CaptureAdvice one = capture_advice(recent);
    set_thread_count(4);
    const CaptureAdvice four = capture_advice(recent);
    set_thread_count(0);
    EXPECT_EQ(one.sentence, four.sentence);
    EXPECT_EQ(one.error, four.error);
    ASSERT_EQ(one.outlooks.size(), four.outlooks.size());
    for (std::size_t i = 0; i < one.outlooks.size(); ++i)
        EXPECT_EQ(one.outlooks[i].error, four.outlooks[i].error);
}

}  // namespace
}  // namespace verdigris
