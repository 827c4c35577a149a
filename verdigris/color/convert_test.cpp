// SPDX-License-Identifier: MIT
#include "verdigris/color/convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace verdigris {
namespace {

TEST(Convert, SrgbCurveHasItsPublishedValues) {
    EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404f, 1e-5f);  // [IEC61966-2-1]
    EXPECT_NEAR(linear_from_srgb(0.04045f), 0.0031308f, 1e-6f);
    EXPECT_FLOAT_EQ(linear_from_srgb(1.0f), 1.0f);
    EXPECT_FLOAT_EQ(linear_from_srgb(-0.5f), -linear_from_srgb(0.5f));
}

TEST(Convert, EveryCodeValueRoundTrips) {
    for (int i = 0; i < 65536; i += 7) {
        const auto v = std::uint16_t(i);
        EXPECT_EQ(u16_from_srgb(srgb_from_linear(linear_from_srgb(srgb_from_u16({v, v, v})))).g, v);
    }
    for (int i = 0; i < 256; ++i) {
        const auto v = std::uint8_t(i);
        EXPECT_EQ(u8_from_srgb(srgb_from_u8({v, v, v})).r, v);
    }
}

TEST(Convert, WhiteIsD65AndNeutral) {
    const Xyz white = xyz_from_linear({1, 1, 1});
    EXPECT_NEAR(white.x, 0.9505f, 1e-4f);
    EXPECT_NEAR(white.z, 1.0890f, 1e-4f);
    const Lab lab = lab_from_xyz(white);
    EXPECT_NEAR(lab.l, 100, 1e-3f);
    EXPECT_NEAR(lab.a, 0, 1e-3f);
    EXPECT_NEAR(lab.b, 0, 1e-3f);
}

TEST(Convert, LabOfPrimariesMatchesLindbloom) {
    // Values of Lindbloom's CIE calculator for sRGB (D65, no adaptation) [Lindbloom].
    const Lab red = lab_from_srgb({1, 0, 0});
    EXPECT_NEAR(red.l, 53.24f, 0.02f);
    EXPECT_NEAR(red.a, 80.09f, 0.05f);
    EXPECT_NEAR(red.b, 67.20f, 0.05f);
    const Lab blue = lab_from_srgb({0, 0, 1});
    EXPECT_NEAR(blue.l, 32.30f, 0.02f);
    EXPECT_NEAR(blue.b, -107.86f, 0.05f);
}

TEST(Convert, XyzAndLabRoundTrip) {
    const LinearF c{0.2f, 0.5f, 0.9f};
    const LinearF back = linear_from_xyz(xyz_from_lab(lab_from_xyz(xyz_from_linear(c))));
    EXPECT_NEAR(back.r, c.r, 1e-5f);
    EXPECT_NEAR(back.g, c.g, 1e-5f);
    EXPECT_NEAR(back.b, c.b, 1e-5f);
}

TEST(Convert, QuantizationClampsAndSwallowsNan) {
    EXPECT_EQ(u8_from_unit(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(u8_from_unit(2.0f), 255);
    EXPECT_EQ(u16_from_unit(-1.0f), 0);
}

}  // namespace
}  // namespace verdigris
