// SPDX-License-Identifier: MIT
#include "verdigris/forecast/context_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace verdigris {
namespace {

Mask all_inside(int width, int height) {
    Mask mask(width, height);
    for (auto& m : mask.pixels()) m = kInside;
    return mask;
}

TEST(SampleInside, GivesAllWhereThereAreFew) {
    Mask mask(7, 5);
    mask(0, 0) = mask(3, 2) = mask(6, 4) = kInside;
    EXPECT_EQ(sample_inside(mask, 3), (std::vector<std::size_t>{0, 17, 34}));
    EXPECT_EQ(sample_inside(mask, 100), (std::vector<std::size_t>{0, 17, 34}));
    EXPECT_TRUE(sample_inside(Mask(7, 5), 10).empty());
}

TEST(SampleInside, GivesAsManyAsAskedInOrderAndTheSameEveryTime) {
    Mask mask = all_inside(61, 47);
    for (int y = 10; y < 30; ++y) {
        for (int x = 5; x < 40; ++x) mask(x, y) = 0;
    }
    const auto sample = sample_inside(mask, 500);
    EXPECT_EQ(sample.size(), 500u);
    EXPECT_TRUE(std::is_sorted(sample.begin(), sample.end()));
    EXPECT_EQ(std::set<std::size_t>(sample.begin(), sample.end()).size(), 500u);
    for (const std::size_t i : sample) EXPECT_EQ(mask.pixels()[i], kInside);
    EXPECT_EQ(sample, sample_inside(mask, 500));
}

// A step of a divisor of the width would meet 4 columns of 512 only, and vertical stripes would
// pass for the whole.
TEST(SampleInside, MeetsEveryColumnAlike) {
    const int width = 512, height = 512, limit = 2048;
    const auto sample = sample_inside(all_inside(width, height), limit);
    ASSERT_EQ(sample.size(), std::size_t(limit));
    std::vector<int> columns(width), rows(height);
    for (const std::size_t i : sample) {
        ++columns[i % width];
        ++rows[i / width];
    }
    // Of 512 columns, 2048 draws at random leave out 512 exp(-4) = 9, and hit none 17 times.
    EXPECT_LT(std::count(columns.begin(), columns.end(), 0), 25);
    EXPECT_LT(*std::max_element(columns.begin(), columns.end()), 17);
    for (const int n : rows) EXPECT_EQ(n, 4);  // a row is four strata
    for (const int period : {2, 4, 8, 16, 32}) {
        std::vector<int> phase(std::size_t(period), 0);
        for (int x = 0; x < width; ++x) phase[std::size_t(x % period)] += columns[std::size_t(x)];
        for (const int n : phase) {
            const double expected = double(limit) / period;
            EXPECT_NEAR(n, expected, 4 * std::sqrt(expected)) << "period " << period;
        }
    }
}

}  // namespace
}  // namespace verdigris
