// SPDX-License-Identifier: MIT
#include "verdigris/simulate/field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verdigris/simulate/random.h"

namespace verdigris {
namespace {

TEST(Random, GaussiansHaveTheMomentsOfOne) {
    const Random random(5, RandomStream::noise_tile);
    double sum = 0, squares = 0, fourth = 0;
    constexpr int kCount = 200000;
    for (int i = 0; i < kCount; ++i) {
        const double v = random.gaussian(std::uint64_t(i));
        sum += v, squares += v * v, fourth += v * v * v * v;
    }
    // Four standard errors of each moment.
    EXPECT_NEAR(sum / kCount, 0, 4 / std::sqrt(kCount));
    EXPECT_NEAR(squares / kCount, 1, 4 * std::sqrt(2.0 / kCount));
    EXPECT_NEAR(fourth / kCount, 3, 4 * std::sqrt(96.0 / kCount));
}

TEST(Random, StreamsAndSeedsDiffer) {
    const Random a(1, RandomStream::light), b(1, RandomStream::jitter), c(2, RandomStream::light);
    EXPECT_NE(a.bits(0), b.bits(0));
    EXPECT_NE(a.bits(0), c.bits(0));
    EXPECT_EQ(a.bits(7), Random(1, RandomStream::light).bits(7));
}

TEST(Random, AnOrnsteinUhlenbeckProcessForgetsAsAsked) {
    const auto v = ornstein_uhlenbeck(Random(3, RandomStream::light), 400000, 0.1, 2);
    double variance = 0, lagged = 0;
    constexpr std::size_t kLag = 20;  // one correlation time
    for (std::size_t i = 0; i + kLag < v.size(); ++i) {
        variance += v[i] * v[i];
        lagged += v[i] * v[i + kLag];
    }
    // 40,000 units hold about 10,000 independent values.
    EXPECT_NEAR(variance / double(v.size() - kLag), 1, 0.06);
    EXPECT_NEAR(lagged / variance, std::exp(-1), 0.04);
}

TEST(Field, CovarianceIsTheOneThatWasAskedFor) {
    // Over many realizations, at one correlation length along x and two along y.
    double here = 0, along = 0, across = 0;
    constexpr int kFields = 4000;
    for (int i = 0; i < kFields; ++i) {
        const GaussianField field(Random(std::uint64_t(i), RandomStream::susceptibility), 0.2, 0.1);
        const double v = field.at(0.4, 0.7);
        here += v * v;
        along += v * field.at(0.6, 0.7);
        across += v * field.at(0.4, 0.9);
    }
    EXPECT_NEAR(here / kFields, 1, 0.09);
    EXPECT_NEAR(along / kFields, std::exp(-0.5), 0.09);
    EXPECT_NEAR(across / kFields, std::exp(-2), 0.09);
}

TEST(Field, TheSamePatternAtAnyResolution) {
    const GaussianField field(Random(1, RandomStream::susceptibility), 0.3, 0.3);
    const CellGrid coarse = cell_grid(1, 1, 32), fine = cell_grid(1, 1, 96);
    const Image<double> a = sampled(field, coarse), b = sampled(field, fine);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            // The middle one of 3 x 3 fine cells has the same center.
            EXPECT_NEAR(a(x, y), b(3 * x + 1, 3 * y + 1), 0.02);
        }
    }
}

TEST(Field, GridsFollowTheAspect) {
    const CellGrid wide = cell_grid(0.8, 0.4, 100);
    EXPECT_EQ(wide.columns, 100);
    EXPECT_EQ(wide.rows, 50);
    EXPECT_NEAR(wide.height, 1, 1e-12);
    EXPECT_NEAR(wide.width, 2, 1e-12);
}

TEST(Field, StandardizedFieldsHaveMeanZeroAndDeviationOne) {
    Image<double> field(3, 1);
    field(0, 0) = 1, field(1, 0) = 2, field(2, 0) = 6;
    standardize(field);
    EXPECT_NEAR(field(0, 0) + field(1, 0) + field(2, 0), 0, 1e-12);
    EXPECT_NEAR((field(2, 0) - field(0, 0)) / (field(1, 0) - field(0, 0)), 5, 1e-12);
    Image<double> constant(4, 4);
    standardize(constant);
    for (const double v : constant.pixels()) EXPECT_EQ(v, 0);
}

TEST(GrayScott, MakesAPatternAndStaysInRange) {
    const Image<double> v = gray_scott(Random(1, RandomStream::reaction), 64, 0.035, 0.060, 4000);
    double least = 1, most = 0, sum = 0, squares = 0;
    for (const double value : v.pixels()) {
        least = std::min(least, value), most = std::max(most, value);
        sum += value, squares += value * value;
    }
    const double mean = sum / double(v.pixel_count());
    EXPECT_GE(least, 0);
    EXPECT_LE(most, 1);
    EXPECT_GT(std::sqrt(squares / double(v.pixel_count()) - mean * mean), 0.05);
}

TEST(GrayScott, WithoutReactionItOnlyDiffuses) {
    // feed = kill = 0 and few steps: what reacts is u v^2, which takes from u what it gives to v,
    // so the sum of v can only grow, and with 0 steps it is the start.
    const Random random(4, RandomStream::reaction);
    const Image<double> start = gray_scott(random, 48, 0, 0, 0),
                        later = gray_scott(random, 48, 0, 0, 50);
    double before = 0, after = 0;
    for (const double v : start.pixels()) before += v;
    for (const double v : later.pixels()) after += v;
    EXPECT_GT(before, 0);
    EXPECT_GE(after, before);
    EXPECT_LT(after, double(start.pixel_count()));
}

}  // namespace
}  // namespace verdigris
