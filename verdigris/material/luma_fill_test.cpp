// SPDX-License-Identifier: MIT
#include "verdigris/material/luma_fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verdigris/color/convert.h"
#include "verdigris/material/testing.h"

namespace verdigris {
namespace {

Mask box(int width, int height, Rect r) {
    Mask mask(width, height);
    for (int y = r.y; y < r.y + r.height; ++y) {
        for (int x = r.x; x < r.x + r.width; ++x) mask(x, y) = kInside;
    }
    return mask;
}

TEST(LumaFill, IsMinusOneWhereNothingIsClipped) {
    const Image<SrgbF> canvas = flat(30, 20, {0.5f, 0.4f, 0.3f});
    const Mask clipped = box(30, 20, {10, 5, 4, 4});
    const Image<float> fill = fill_luma(canvas, {}, clipped);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 30; ++x) {
            if (clipped(x, y)) {
                EXPECT_NEAR(fill(x, y), luma({0.5f, 0.4f, 0.3f}), 1e-5);
            } else {
                EXPECT_EQ(fill(x, y), -1);
            }
        }
    }
    const Image<float> unclipped = fill_luma(canvas, {}, {});
    for (float v : unclipped.pixels()) EXPECT_EQ(v, -1);
}

TEST(LumaFill, BridgesAGlintSmoothly) {
    // A gentle slope with a burnt-out streak, as a flash leaves it on the plate.
    const auto slope = [](int x, int y) { return 0.3 + 0.002 * x + 0.001 * y; };
    Image<SrgbF> canvas = paint(128, 96, [&](int x, int y) {
        const float v = float(slope(x, y));
        return SrgbF{v, v, v};
    });
    const Mask clipped = box(128, 96, {50, 0, 20, 96});
    for (int y = 0; y < 96; ++y) {
        for (int x = 50; x < 70; ++x) canvas(x, y) = {1, 1, 1};
    }
    const Image<float> fill = fill_luma(canvas, {}, clipped);
    double worst = 0, roughest = 0;
    for (int y = 2; y < 94; ++y) {
        for (int x = 50; x < 70; ++x) {
            worst = std::max(worst, std::abs(double(fill(x, y)) - slope(x, y)));
            if (x > 50)
                roughest = std::max(roughest, std::abs(double(fill(x, y) - fill(x - 1, y))));
        }
    }
    EXPECT_LT(worst, 0.03);
    EXPECT_LT(roughest, 0.012);
}

TEST(LumaFill, TakesNothingFromTheBackdrop) {
    Image<SrgbF> canvas = flat(64, 64, {1, 1, 1});
    const Mask specimen = box(64, 64, {16, 16, 32, 32});
    for (int y = 16; y < 48; ++y) {
        for (int x = 16; x < 48; ++x) canvas(x, y) = {0.25f, 0.25f, 0.25f};
    }
    Mask clipped = box(64, 64, {30, 16, 5, 32});
    clipped(2, 2) = kInside;  // on the backdrop: none of our business
    const Image<float> fill = fill_luma(canvas, specimen, clipped);
    EXPECT_EQ(fill(2, 2), -1);
    for (int y = 16; y < 48; ++y) EXPECT_NEAR(fill(32, y), 0.25, 1e-5);
}

TEST(LumaFill, WithNothingKnownFillsNothing) {
    const Image<SrgbF> canvas = flat(9, 7, {1, 1, 1});
    const Image<float> fill = fill_luma(canvas, {}, box(9, 7, {0, 0, 9, 7}));
    for (float v : fill.pixels()) EXPECT_EQ(v, -1);
}

}  // namespace
}  // namespace verdigris
