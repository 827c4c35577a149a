// SPDX-License-Identifier: MIT
#include "verdigris/render/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/color/convert.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

void expect_near(LinearF a, LinearF b) {
    EXPECT_NEAR(a.r, b.r, 1e-5f);
    EXPECT_NEAR(a.g, b.g, 1e-5f);
    EXPECT_NEAR(a.b, b.b, 1e-5f);
}

// By hand from the published formula [PbrNeutral].
TEST(PbrNeutral, KnownValues) {
    expect_near(pbr_neutral({0, 0, 0}), {0, 0, 0});
    expect_near(pbr_neutral(gray(0.5f)), gray(0.46f));  // minus F0
    expect_near(pbr_neutral({0.5f, 0.3f, 0.1f}), {0.46f, 0.26f, 0.06f});
    expect_near(pbr_neutral(gray(0.04f)), gray(6.25f * 0.0016f));  // the toe: 6.25 x^2
    expect_near(pbr_neutral(gray(0.8f)), gray(0.76f));             // where compression starts
    // Peak 0.96 after the offset: 1 - 0.24^2 / (0.96 + 0.24 - 0.76).
    expect_near(pbr_neutral(gray(1)), gray(1 - 0.0576f / 0.44f));
    // Red 4, green and blue 1: offset 0.04, peak 3.96, rolled 1 - 0.0576 / 3.44.
    const float rolled = 1 - 0.0576f / 3.44f, g = 1 / (0.15f * (3.96f - rolled) + 1);
    const float low = 0.96f * rolled / 3.96f;
    expect_near(pbr_neutral({4, 1, 1}),
                {rolled, low * g + rolled * (1 - g), low * g + rolled * (1 - g)});
}

TEST(PbrNeutral, NothingClipsAndOrderIsKept) {
    float before = -1;
    for (float v = 0; v < 100; v = v * 1.1f + 0.001f) {
        const LinearF c = pbr_neutral({v, 0.5f * v, 0.2f * v});
        EXPECT_GT(c.r, before);
        EXPECT_LT(c.r, 1);
        EXPECT_LE(c.b, c.g);
        EXPECT_LE(c.g, c.r);
        before = c.r;
    }
    expect_near(pbr_neutral({-1, -2, 0}), {0, 0, 0});
}

TEST(Developed, MeanOfAFlatFieldIsExactAlthoughCodesAreWhole) {
    Image<LinearF> field(128, 128);
    for (LinearF& c : field.pixels()) c = gray(0.2f);
    const Image<SrgbU8> picture = developed(field);
    double sum = 0;
    for (const SrgbU8& c : picture.pixels()) {
        sum += c.r;
        EXPECT_EQ(c.r, c.g);
    }
    EXPECT_NEAR(sum / double(field.pixel_count()), double(srgb_from_linear(0.16f)) * 255, 0.05);
}

TEST(Developed, ExposureCountsStops) {
    Image<LinearF> dark(8, 8), bright(8, 8);
    for (LinearF& c : dark.pixels()) c = gray(0.1f);
    for (LinearF& c : bright.pixels()) c = gray(0.4f);
    EXPECT_EQ(developed(dark, 2)(3, 3), developed(bright)(3, 3));
}

}  // namespace
}  // namespace verdigris
