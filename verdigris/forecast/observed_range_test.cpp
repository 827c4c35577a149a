// SPDX-License-Identifier: MIT
#include "verdigris/forecast/observed_range.h"

#include <gtest/gtest.h>

#include <utility>

#include "verdigris/error.h"
#include "verdigris/forecast/affine.h"

namespace verdigris {
namespace {

// Red rises by 0.1 a unit from 0.2 to 0.6 over five frames; green and blue stand still.
Context rising() {
    Context context;
    for (int k = 0; k < 5; ++k) {
        Image<SrgbF> frame(20, 10);
        for (SrgbF& c : frame.pixels()) c = {0.2f + 0.1f * float(k), 0.5f, 0.3f};
        context.frames.push_back(std::move(frame));
    }
    return context;
}

Forecaster free_drift() {
    return affinergb({AffineFamily::full, 1, 0, FitPixels::all, false});
}

TEST(ObservedRange, StopsAtTheColorsOfTheContextAndItsMargin) {
    const Context context = rising();
    const Forecast free = free_drift().forecast(context);
    EXPECT_NEAR(free.at(10)(3, 3).r, 1.6f, 1e-4f);
    // Observed 0.2 to 0.6; half of that more is 0.8.
    const Forecast kept = within_observed_range(free_drift(), {1, 2, 5, 10}).forecast(context);
    EXPECT_NEAR(kept.at(1)(3, 3).r, 0.7f, 1e-4f);
    EXPECT_NEAR(kept.at(2)(3, 3).r, 0.8f, 1e-4f);
    EXPECT_NEAR(kept.at(5)(3, 3).r, 0.8f, 1e-4f);
    EXPECT_NEAR(kept.at(10)(3, 3).r, 0.8f, 1e-4f);
    EXPECT_NEAR(kept.at(10)(3, 3).g, 0.5f, 1e-4f);
    // Never beyond what a screen shows, however wide the margin.
    EXPECT_EQ(within_observed_range(free_drift(), {10}, 5).forecast(context).at(10)(3, 3).r, 1.0f);
}

TEST(ObservedRange, APixelThatBeginsOutsideStaysWhereItIs) {
    Context context = rising();
    for (Image<SrgbF>& f : context.frames) f(0, 0) = {0.95f, 0.5f, 0.3f};  // 0.5 %: a speck
    const Forecast kept = within_observed_range(free_drift(), {10}).forecast(context);
    EXPECT_EQ(kept.at(0)(0, 0), context.frames.back()(0, 0));
    EXPECT_LE(kept.at(10)(0, 0).r, 0.95f);
    EXPECT_NEAR(kept.at(10)(3, 3).r, 0.8f, 1e-4f);
}

TEST(ObservedRange, TheBackdropDoesNotWidenIt) {
    Context context = rising();
    context.backdrop = Mask(20, 10);
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 5; ++x) {
            context.backdrop(x, y) = kInside;
            for (Image<SrgbF>& f : context.frames) f(x, y) = {0.99f, 0.99f, 0.99f};
        }
    }
    EXPECT_NEAR(within_observed_range(free_drift(), {10}).forecast(context).at(10)(9, 3).r, 0.8f,
                1e-3f);
}

TEST(ObservedRange, RefusesWhatItCannotKeep) {
    EXPECT_THROW(within_observed_range(free_drift(), {}), Error);
    EXPECT_THROW(within_observed_range(free_drift(), {5, 5}), Error);
    EXPECT_THROW(within_observed_range(free_drift(), {0}), Error);
    EXPECT_THROW(within_observed_range(free_drift(), {5}, -1), Error);
}

}  // namespace
}  // namespace verdigris
