// SPDX-License-Identifier: MIT
#include "verdigris/metrics/flip_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace verdigris {
namespace {

FlipResult pooled(const std::vector<float>& errors, int width) {
    FlipResult r;
    r.map = Image<float>(width, int(errors.size()) / width);
    std::copy(errors.begin(), errors.end(), r.map.pixels().begin());
    pool_errors(r);
    return r;
}

// 0.1 + 0.1 + 0.2 + 0.6: a quarter of 1.0 lies in the 0.2, half and three quarters in the 0.6.
TEST(FlipPool, WeighsErrorsByThemselves) {
    const FlipResult r = pooled({0.6f, 0.1f, 0.2f, 0.1f}, 2);
    EXPECT_NEAR(r.mean, 0.25, 1e-7);
    EXPECT_EQ(r.minimum, double(0.1f));
    EXPECT_EQ(r.maximum, double(0.6f));
    EXPECT_EQ(r.first_quartile, double(0.2f));
    EXPECT_EQ(r.median, double(0.6f));
    EXPECT_EQ(r.third_quartile, double(0.6f));
}

TEST(FlipPool, OfNothingSeenIsZero) {
    const FlipResult r = pooled(std::vector<float>(12, 0.0f), 4);
    EXPECT_EQ(r.mean, 0);
    EXPECT_EQ(r.maximum, 0);
    EXPECT_EQ(r.first_quartile, 0);
    EXPECT_EQ(r.third_quartile, 0);
}

TEST(FlipPool, OfTheLargestEverywhereIsOne) {
    const FlipResult r = pooled(std::vector<float>(12, 1.0f), 4);
    EXPECT_EQ(r.mean, 1);
    EXPECT_EQ(r.median, 1);
}

// The bins and the search are short cuts: sorting everything finds the same.
void expect_as_sorted(double scale, double offset) {
    std::mt19937 bits(5);
    std::vector<float> errors;
    for (int i = 0; i < 90 * 311; ++i) {
        const float u = float(bits() >> 8) * 0x1p-24f;
        errors.push_back(i % 3 == 0 ? 0 : float(offset + scale * double(u * u)));
    }
    const FlipResult r = pooled(errors, 90);
    std::sort(errors.begin(), errors.end());
    double sum = 0;
    for (const float e : errors) sum += double(e);
    const auto quantile = [&](double share) {
        double running = 0;
        for (const float e : errors) {
            if ((running += double(e)) > share * sum) return double(e);
        }
        return -1.0;
    };
    EXPECT_NEAR(r.mean, sum / double(errors.size()), 1e-12);
    EXPECT_EQ(r.first_quartile, quantile(0.25));
    EXPECT_EQ(r.median, quantile(0.5));
    EXPECT_EQ(r.third_quartile, quantile(0.75));
}
TEST(FlipPool, AgreesWithSortingAll) {
    expect_as_sorted(1, 0);
}
TEST(FlipPool, AgreesWithSortingAllOfOneBin) {
    expect_as_sorted(1e-4, 0.7);
}

}  // namespace
}  // namespace verdigris
