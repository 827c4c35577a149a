// SPDX-License-Identifier: MIT
#include "verdigris/observe/noise.h"

#include <gtest/gtest.h>

#include "verdigris/color/convert.h"
#include "verdigris/observe/testing/made_scene.h"

namespace verdigris {
namespace {

// A ramp in space and time plus Gaussian noise; rounded to `levels` if positive.
Image<SrgbF> noisy(int t, double sigma, int levels, int width = 64, int height = 64) {
    Image<SrgbF> image(width, height);
    std::uint64_t key = std::uint64_t(t) * 1000003;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float v[3];
            for (float& c : v) {
                c = float(0.3 + 0.002 * x + 0.004 * t + sigma * testing::gaussian(key++));
                if (levels > 0) c = std::round(c * float(levels)) / float(levels);
            }
            image(x, y) = {v[0], v[1], v[2]};
        }
    }
    return image;
}

TEST(Noise, IsRecoveredUnderLinearAging) {
    for (const double sigma : {0.001, 0.005, 0.02}) {
        NoiseMeter meter(64, 64);
        for (int t = 0; t < 20; ++t) meter.add(t, noisy(t, sigma, 0));
        ASSERT_TRUE(meter.sigma());
        EXPECT_NEAR(*meter.sigma(), sigma, 0.02 * sigma);
    }
}

TEST(Noise, IsRecoveredFromEightBitPictures) {
    // Rounding adds 1/12 of a step squared to the variance.
    for (const double steps : {0.7, 1.0, 3.4}) {
        NoiseMeter meter(64, 64);
        for (int t = 0; t < 20; ++t) meter.add(t, noisy(t, steps / 255, 255));
        const double expected = std::sqrt(steps * steps + 1 / 12.0) / 255;
        EXPECT_NEAR(*meter.sigma(), expected, 0.05 * expected) << steps;
    }
}

TEST(Noise, OfAStillPictureIsZeroEvenWithAGlint) {
    NoiseMeter meter(64, 64);
    for (int t = 0; t < 10; ++t) {
        Image<SrgbF> image = noisy(0, 0, 255);
        image(t, t) = {0.9f, 0.9f, 0.9f};
        meter.add(t, image);
    }
    EXPECT_EQ(*meter.sigma(), 0);
    EXPECT_DOUBLE_EQ(noise_from(0, {}).tau, 5e-4);
}

TEST(Noise, CountsTheSpecimenOnlyBeforeOrAfter) {
    Mask left(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 32; ++x) left(x, y) = kInside;
    }
    NoiseMeter before(64, 64), after(64, 64);
    before.only_inside(left.clone());
    for (int t = 0; t < 12; ++t) {
        Image<SrgbF> image = noisy(t, 0.004, 0);
        const Image<SrgbF> loud = noisy(t + 100, 0.04, 0);
        for (int y = 0; y < 64; ++y) {
            for (int x = 32; x < 64; ++x) image(x, y) = loud(x, y);
        }
        before.add(t, image);
        after.add(t, image);
    }
    EXPECT_NEAR(*before.sigma(left), 0.004, 2e-4);
    EXPECT_NEAR(*after.sigma(left), 0.004, 2e-4);
    EXPECT_GT(*after.sigma(), 0.006);
}

TEST(Noise, ClippedPixelsHaveNoSay) {
    NoiseMeter meter(64, 64);
    for (int t = 0; t < 12; ++t) {
        Image<SrgbF> image = noisy(t, 0.01, 0);
        for (int y = 0; y < 50; ++y) {
            for (int x = 0; x < 64; ++x) image(x, y) = {1, 1, 1};
        }
        meter.add(t, image);
    }
    EXPECT_NEAR(*meter.sigma(), 0.01, 5e-4);
}

TEST(Noise, NeedsThreeSamplesInARow) {
    NoiseMeter meter(64, 64);
    for (const int t : {0, 1, 3, 4, 6}) meter.add(t, noisy(t, 0.01, 0));
    EXPECT_FALSE(meter.sigma());
    meter.add(7, noisy(7, 0.01, 0));
    meter.add(8, noisy(8, 0.01, 0));
    EXPECT_NEAR(*meter.sigma(), 0.01, 5e-4);
}

TEST(Noise, FromOnePictureIgnoresSlopes) {
    EXPECT_NEAR(spatial_sigma(noisy(3, 0.01, 0), {}), 0.01, 5e-4);
    EXPECT_EQ(spatial_sigma(Image<SrgbF>(8, 8), {}), 0);  // black is clipped: nothing to measure
}

TEST(Noise, TauFollowsSigmaUnlessGiven) {
    EXPECT_DOUBLE_EQ(noise_from(0.01, {}).tau, 0.024);
    EXPECT_FALSE(noise_from(0.01, {}).tau_given);
    EXPECT_DOUBLE_EQ(noise_from(0.01, 0.002).tau, 0.002);
    EXPECT_TRUE(noise_from(0.01, 0.002).tau_given);
}

}  // namespace
}  // namespace verdigris
