// SPDX-License-Identifier: MIT
#include "verdigris/metrics/flip_filters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/metrics/flip.h"

namespace verdigris {
namespace {

double two_sided(const std::vector<float>& taps) {
    double sum = double(taps[0]);
    for (std::size_t i = 1; i < taps.size(); ++i) sum += 2 * double(taps[i]);
    return sum;
}

// Taps of the two-dimensional filters as the authors' code has them: center, 1 and 3 to the right.
TEST(FlipFilters, AreTheAuthors) {
    const FlipFilters f = flip_filters(kFlipPixelsPerDegree);
    const auto at = [](const std::vector<float>& t, std::size_t i) { return t[0] * t[i]; };
    EXPECT_NEAR(at(f.luma, 0), 0.148811, 1e-6);
    EXPECT_NEAR(at(f.luma, 1), 0.093240, 1e-6);
    EXPECT_NEAR(at(f.luma, 3), 0.002215, 1e-6);
    EXPECT_NEAR(at(f.red_green, 0), 0.131964, 1e-6);
    EXPECT_NEAR(at(f.red_green, 1), 0.087178, 1e-6);
    EXPECT_NEAR(at(f.red_green, 3), 0.003162, 1e-6);
    const auto blue = [&](std::size_t i) { return at(f.blue_wide, i) + at(f.blue_narrow, i); };
    EXPECT_NEAR(blue(0), 0.020001, 1e-6);
    EXPECT_NEAR(blue(1), 0.018727, 1e-6);
    EXPECT_NEAR(blue(3), 0.011154, 1e-6);
    EXPECT_EQ(f.blue_wide.size(), 11u);  // radius 10
    EXPECT_EQ(f.smooth.size(), 10u);     // radius 9
    EXPECT_EQ(f.reach(), 10);
}

TEST(FlipFilters, SumToWhatTheyMust) {
    for (const double ppd : {1.0, 3.0, 20.0, 67.0, 400.0}) {
        const FlipFilters f = flip_filters(ppd);
        EXPECT_NEAR(two_sided(f.luma), 1, 1e-6) << ppd;
        EXPECT_NEAR(two_sided(f.red_green), 1, 1e-6) << ppd;
        EXPECT_NEAR(std::hypot(two_sided(f.blue_wide), two_sided(f.blue_narrow)), 1, 1e-6) << ppd;
        EXPECT_NEAR(two_sided(f.smooth), 1, 1e-6) << ppd;
        EXPECT_NEAR(two_sided(f.point), 0, 1e-6) << ppd;
        double rise = 0, edge = 0;
        for (std::size_t i = 0; i < f.point.size(); ++i) {
            rise += f.point[i] > 0 ? 2 * double(f.point[i]) : 0;
            edge += double(f.edge[i]);
        }
        EXPECT_NEAR(rise, 1, 1e-6) << ppd;
        EXPECT_NEAR(edge, 1, 1e-6) << ppd;
        EXPECT_LE(f.luma.size(), f.smooth.size()) << ppd;
        EXPECT_LE(f.red_green.size(), f.blue_wide.size()) << ppd;
    }
}

}  // namespace
}  // namespace verdigris
