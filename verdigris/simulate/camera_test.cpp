// SPDX-License-Identifier: MIT
#include "verdigris/simulate/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

Image<LinearF> even(int width, int height, LinearF c) {
    Image<LinearF> image(width, height);
    std::fill(image.pixels().begin(), image.pixels().end(), c);
    return image;
}

/// A camera that changes nothing, with 16 bits.
SimulationSpec quiet(int width = 64, int height = 64) {
    SimulationSpec spec;
    spec.frames.width = width;
    spec.frames.height = height;
    spec.camera = CameraSpec{.exposure = 1, .bits = 16};
    return spec;
}

FrameGains no_gain() {
    FrameGains g;
    g.linear = {1, 1, 1};
    return g;
}

TEST(Camera, WithoutNoiseItIsTheSrgbCurve) {
    const SimulationSpec spec = quiet();
    const Camera camera(spec);
    const auto a = even(64, 64, {0.1f, 0.4f, 1.5f}), b = even(64, 64, {0.3f, 0.4f, 1.5f});
    Image<SrgbU16> deep;
    camera.expose(a, b, 0.25, no_gain(), 0, deep);
    EXPECT_EQ(deep(5, 5).r, u16_from_unit(srgb_from_linear(0.15f)));
    EXPECT_EQ(deep(5, 5).b, 65535) << "over 1 is saturated";
    Image<SrgbU8> frame;
    for (int i = 1; i <= 100; ++i) {
        const float v = float(i) / 100;
        const auto light = even(4, 1, {v, v / 10, v});
        camera.expose(light, light, 0, no_gain(), 0, frame);
        EXPECT_NEAR(frame(1, 0).r, 255 * srgb_from_linear(v), 0.52f);
        EXPECT_NEAR(frame(1, 0).g, 255 * srgb_from_linear(v / 10), 0.6f);
    }
}

TEST(Camera, NoiseHasTheVarianceThatWasAsked) {
    for (const int frames_per_sample : {1, 4}) {
        SimulationSpec spec = quiet(96, 96);
        spec.frames.count = 984 * frames_per_sample;
        spec.camera.shot_noise = 2e-5;
        spec.camera.read_noise = 0.002;
        const Camera camera(spec);
        for (const float v : {0.05f, 0.5f}) {
            const auto light = even(96, 96, {v, v, v});
            double sum = 0, squares = 0, count = 0;
            Image<SrgbU16> frame;
            for (int i = 0; i < 20; ++i) {
                camera.expose(light, light, 0, no_gain(), i, frame);
                for (const SrgbU16 c : frame.pixels()) {
                    for (const std::uint16_t code : {c.r, c.g, c.b}) {
                        const double d = double(linear_from_srgb(float(code) / 65535)) - double(v);
                        sum += d, squares += d * d, ++count;
                    }
                }
            }
            const double asked = (2e-5 * double(v) + 4e-6) * frames_per_sample;
            const double mean = sum / count, variance = squares / count - mean * mean;
            // 99.99 % intervals: four standard errors of a mean and of a variance.
            EXPECT_NEAR(mean, 0, 4 * std::sqrt(asked / count) + 1e-5);
            EXPECT_NEAR(variance / asked, 1, 4 * std::sqrt(2 / count) + 0.003)
                << v << " with " << frames_per_sample;
        }
    }
}

TEST(Camera, NoiseIsNewInEveryFrameAndRow) {
    SimulationSpec spec = quiet(64, 64);
    spec.camera.read_noise = 0.01;
    const Camera camera(spec);
    const auto light = even(64, 64, {0.5f, 0.5f, 0.5f});
    Image<SrgbU16> a, b, again;
    camera.expose(light, light, 0, no_gain(), 0, a);
    camera.expose(light, light, 0, no_gain(), 1, b);
    camera.expose(light, light, 0, no_gain(), 0, again);
    EXPECT_TRUE(std::equal(a.pixels().begin(), a.pixels().end(), again.pixels().begin()));
    double frames = 0, rows = 0, channels = 0, power = 0;
    for (int y = 0; y + 1 < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double mean = 65535 * double(srgb_from_linear(0.5f));
            const double here = a(x, y).r - mean;
            frames += here * (b(x, y).r - mean);
            rows += here * (a(x, y + 1).r - mean);
            channels += here * (a(x, y).g - mean);
            power += here * here;
        }
    }
    // 4,032 pairs: a correlation of independent noise stays within four of its standard errors.
    for (const double product : {frames, rows, channels})
        EXPECT_LT(std::abs(product / power), 0.065);
}

TEST(Camera, AffineDriftIsExact) {
    SimulationSpec spec = quiet();
    spec.camera.drift_gain = {1.05, 0.9, 1};
    spec.camera.drift_offset = {-0.02, 0.03, 0.01};
    CameraTrack track(spec);
    for (int i = 0; i <= 984; ++i) track.see(0.3);
    const Camera camera(spec);
    const auto light = even(64, 64, {0.2f, 0.3f, 0.4f});
    Image<SrgbU16> frame;
    for (const double unit : {0.0, 30.0, 98.4}) {
        camera.expose(light, light, 0, track.gains(unit), 0, frame);
        const double u = unit / 98.4;
        const auto expected = [&](float v, double gain, double offset) {
            return 65535 * (double(srgb_from_linear(v)) * (1 + (gain - 1) * u) + offset * u);
        };
        EXPECT_NEAR(frame(3, 3).r, expected(0.2f, 1.05, -0.02), 0.6);
        EXPECT_NEAR(frame(3, 3).g, expected(0.3f, 0.9, 0.03), 0.6);
        EXPECT_NEAR(frame(3, 3).b, expected(0.4f, 1, 0.01), 0.6);
    }
}

TEST(Camera, FlickerRollsThroughTheFrameWithItsAmplitude) {
    SimulationSpec spec = quiet(8, 240);
    spec.camera.flicker = 0.05;
    spec.camera.flicker_bands = 2;
    const Camera camera(spec);
    const auto light = even(8, 240, {0.5f, 0.5f, 0.5f});
    Image<SrgbU16> a, b;
    camera.expose(light, light, 0, no_gain(), 0, a);
    FrameGains later = no_gain();
    later.flicker_phase = 0.3;
    camera.expose(light, light, 0, later, 1, b);
    double least = 2, most = 0;
    for (int y = 0; y < 240; ++y) {
        const double v = double(linear_from_srgb(float(a(0, y).r) / 65535)) / 0.5;
        least = std::min(least, v), most = std::max(most, v);
    }
    EXPECT_NEAR(least, 0.95, 0.001);
    EXPECT_NEAR(most, 1.05, 0.001);
    EXPECT_NE(a(0, 0).r, b(0, 0).r);
}

TEST(CameraTrack, TheExposureLoopTakesBackItsShareWithItsLag) {
    SimulationSpec spec = quiet();
    spec.camera.auto_exposure = 0.6;
    spec.camera.auto_exposure_lag = 3;
    CameraTrack track(spec);
    // The scene darkens by a fifth at unit 10, for good.
    for (int i = 0; i <= 984; ++i) track.see(i < 100 ? 0.5 : 0.4);
    EXPECT_NEAR(track.gains(9).exposure, 1, 1e-12);
    const double final_log = 0.6 * std::log(0.5 / 0.4);
    EXPECT_NEAR(std::log(track.gains(90).exposure), final_log, 1e-6);
    // One lag after the change: 1 - 1/e of the way.
    EXPECT_NEAR(std::log(track.gains(10 + 3 + 0.1).exposure) / final_log, 1 - std::exp(-1), 0.02);
}

TEST(CameraTrack, DriftsHaveTheDeviationsThatWereAsked) {
    SimulationSpec spec = quiet();
    spec.frames.units = 10000;  // many correlation times
    spec.camera.light_drift = 0.03;
    spec.camera.light_correlation = 2;
    spec.camera.white_balance = 0.01;
    spec.camera.white_balance_correlation = 2;
    CameraTrack track(spec);
    double light = 0, red = 0, shared = 0;
    constexpr int kNodes = 100000;
    for (int i = 0; i < kNodes; ++i) {
        track.see(0.5);
        const FrameGains g = track.gains(i * 0.1);
        light += std::log(g.light) * std::log(g.light);
        const double r = std::log(g.linear[0] / g.light);
        red += r * r;
        shared = std::max(shared, std::abs(std::log(g.linear[0] * g.linear[1] * g.linear[2] /
                                                    std::pow(g.light, 3))));
    }
    // About 5,000 independent values: two per cent of the deviation, times three.
    EXPECT_NEAR(std::sqrt(light / kNodes), 0.03, 0.002);
    EXPECT_NEAR(std::sqrt(red / kNodes), 0.01, 0.0007);
    EXPECT_LT(shared, 1e-9) << "a color balance is no exposure";
}

TEST(CameraTrack, JitterIsIndependentFromSampleToSample) {
    SimulationSpec spec = quiet();
    spec.frames.units = 2000;
    spec.camera.jitter = 0.004;
    CameraTrack track(spec);
    double power = 0, lagged = 0, last = 0;
    constexpr int kNodes = 20000;
    for (int i = 0; i < kNodes; ++i) {
        track.see(0.5);
        const double j = std::log(track.gains(i * 0.1).jitter);
        power += j * j;
        lagged += j * last;
        last = j;
    }
    EXPECT_NEAR(std::sqrt(power / kNodes), 0.004, 4 * 0.004 / std::sqrt(2.0 * kNodes));
    EXPECT_LT(std::abs(lagged / power), 4 / std::sqrt(double(kNodes)));
}

TEST(Camera, TheSameAtAnyThreadCount) {
    SimulationSpec spec = quiet(70, 50);
    spec.camera.read_noise = 0.01;
    spec.camera.flicker = 0.01;
    const auto light = even(70, 50, {0.5f, 0.4f, 0.3f});
    std::vector<Image<SrgbU8>> frames(2);
    for (const int threads : {1, 3}) {
        set_thread_count(threads);
        Camera(spec).expose(light, light, 0, no_gain(), 3, frames[threads == 1 ? 0 : 1]);
    }
    set_thread_count(0);
    EXPECT_TRUE(std::equal(frames[0].pixels().begin(), frames[0].pixels().end(),
                           frames[1].pixels().begin()));
}

}  // namespace
}  // namespace verdigris
