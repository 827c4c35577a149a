// SPDX-License-Identifier: MIT
#include "verdigris/color/magma.h"

#include <gtest/gtest.h>

#include <limits>

#include "verdigris/color/convert.h"

namespace verdigris {
namespace {

TEST(Magma, GrowsLighterFromBlack) {
    Image<float> ramp(100, 1);
    for (int x = 0; x < 100; ++x) ramp(x, 0) = float(x) / 99;
    const Image<SrgbU8> colors = magma(ramp, 1);
    EXPECT_LT(colors(0, 0).r + colors(0, 0).g + colors(0, 0).b, 12);
    // The table's end in Matplotlib: (252, 253, 191).
    EXPECT_NEAR(colors(99, 0).r, 252, 1);
    EXPECT_NEAR(colors(99, 0).g, 253, 1);
    EXPECT_NEAR(colors(99, 0).b, 191, 1);
    float before = -1;
    for (int x = 0; x < 100; ++x) {
        const SrgbU8 c = colors(x, 0);
        const float light = luma(srgb_from_u8(c));
        EXPECT_GE(light, before - 0.005f);
        before = light;
    }
}

TEST(Magma, WhatLiesOutsideAndWhatIsNoNumberHasAColor) {
    Image<float> map(5, 1);
    map(0, 0) = std::numeric_limits<float>::quiet_NaN();
    map(1, 0) = -std::numeric_limits<float>::infinity();
    map(2, 0) = std::numeric_limits<float>::infinity();
    map(3, 0) = 3;
    map(4, 0) = 1;
    const Image<SrgbU8> colors = magma(map, 2);
    EXPECT_EQ(colors(0, 0), magma_table().front());
    EXPECT_EQ(colors(1, 0), magma_table().front());
    EXPECT_EQ(colors(2, 0), magma_table().back());
    EXPECT_EQ(colors(3, 0), magma_table().back());
    EXPECT_EQ(colors(4, 0), (SrgbU8{183, 55, 121}));  // Matplotlib's entry 128, rounded
}

}  // namespace
}  // namespace verdigris
