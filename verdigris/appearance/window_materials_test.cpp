// SPDX-License-Identifier: MIT
#include "verdigris/appearance/window_materials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verdigris/appearance/testing.h"
#include "verdigris/forecast/affine.h"

namespace verdigris {
namespace {

/// Visits one window of two recordings with `body`.
template <class Body>
void one_window(const Body& body) {
    EvaluationProtocol p = testing::aging_protocol(1);
    p.horizons = 12;
    p.embargo = 0;
    p.train_fraction = p.validation_fraction = 0;
    const std::vector<Observation> list = testing::two_agings();
    int visited = 0;
    evaluate(p, list, {}, {}, [&](const ScoredWindow& w) {
        ++visited;
        EXPECT_EQ(w.start, 0);
        EXPECT_EQ(w.context.frames.size(), 5u);
        EXPECT_EQ(w.forecasts.size(), 1u);
        // Unit k after the last context frame, of this very recording.
        const Image<SrgbF> real = w.observation.store->image(40 + 120);
        EXPECT_TRUE(std::ranges::equal(w.truth(12).pixels(), real.pixels()));
        body(w);
    });
    EXPECT_EQ(visited, 2);
}

TEST(WindowMaterials, TheObservedStateIsCleanAndTheTrueFutureIsNot) {
    one_window([](const ScoredWindow& w) {
        const WindowMaterials materials(w, 12, CoverageScale::truth);
        const Material now = materials.material(w.context.frames.back(), 0),
                       then = materials.material(w.truth(10), 10);
        for (const float p : now.coverage.pixels()) EXPECT_EQ(p, 0);
        // The right half is specimen, and at the reference horizon nearly all patina; the rest is
        // backdrop and no metal.
        EXPECT_GT(then.coverage(18, 8), 0.8f);
        EXPECT_EQ(then.coverage(3, 8), 0);
        EXPECT_LT(then.metallic(3, 8), 0.1f);
        EXPECT_LT(then.metallic(18, 8), now.metallic(18, 8));
    });
}

TEST(WindowMaterials, OneScaleForAWindowOrOneForEachFrame) {
    one_window([](const ScoredWindow& w) {
        const WindowMaterials fixed(w, 12, CoverageScale::truth);
        const WindowMaterials own(w, 12, CoverageScale::frame);
        // The median of the context is two units old, and the dead-zone what was moved since. Four
        // units on that leaves 4 of the 12 units that are full patina by the window's scale, and of
        // 6 by the frame's own; then Eq. (2)'s exponent.
        EXPECT_NEAR(fixed.material(w.truth(4), 4).coverage(18, 8), std::pow(4.0 / 12, 0.85), 0.03);
        EXPECT_NEAR(own.material(w.truth(4), 4).coverage(18, 8), std::pow(4.0 / 6, 0.85), 0.03);
        EXPECT_EQ(fixed.recipe().reference_horizon, 10);
    });
    one_window([](const ScoredWindow& w) {
        // Nothing beyond what is judged is looked at.
        EXPECT_EQ(WindowMaterials(w, 6, CoverageScale::truth).recipe().reference_horizon, 6);
    });
}

Image<SrgbF> filled(SrgbF c) {
    Image<SrgbF> image(4, 2);
    std::ranges::fill(image.pixels(), c);
    return image;
}

TEST(FrameMotion, KnownNumbers) {
    const Image<SrgbF> last = filled({0.5f, 0.5f, 0.5f}), truth = filled({0.4f, 0.5f, 0.5f});
    const Rect all{0, 0, 4, 2};
    const FrameMotion perfect = frame_motion(truth, truth, last, all);
    EXPECT_EQ(perfect.error, 0);
    EXPECT_NEAR(perfect.moved, 0.1 / 3, 1e-7);
    EXPECT_NEAR(perfect.agreement, 1, 1e-12);
    const FrameMotion away = frame_motion(filled({0.6f, 0.5f, 0.5f}), truth, last, all);
    EXPECT_NEAR(away.agreement, -1, 1e-12);
    EXPECT_NEAR(away.error, 0.04 / 3, 1e-7);
    EXPECT_TRUE(std::isnan(frame_motion(last, truth, last, all).agreement));
    // One channel of one pixel beyond: an eighth of the pixels, a 24th of the channels.
    Image<SrgbF> beyond = truth.clone();
    beyond(1, 1).g = 1.2f;
    const FrameMotion out = frame_motion(beyond, truth, last, all);
    EXPECT_NEAR(out.outside_pixels, 1.0 / 8, 1e-12);
    EXPECT_NEAR(out.outside_channels, 1.0 / 24, 1e-12);
    EXPECT_EQ(frame_motion(beyond, truth, last, {0, 0, 1, 1}).outside_pixels, 0);
}

TEST(FrameMotion, AClampedForecastIsSeenWithoutItsClamp) {
    Context context;
    for (int k = 0; k < 5; ++k)
        context.frames.push_back(filled({0.5f + 0.1f * float(k), 0.5f, 0.5f}));
    const Forecast clamped =
        affinergb({AffineFamily::full, 1, 0, FitPixels::all, true}).forecast(context);
    EXPECT_LE(clamped.at(10)(0, 0).r, 1.0f);
    EXPECT_NEAR(unclamped(clamped, 10)(0, 0).r, 1.9f, 1e-4f);
}

}  // namespace
}  // namespace verdigris
