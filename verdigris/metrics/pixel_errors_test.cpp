// SPDX-License-Identifier: MIT
#include "verdigris/metrics/pixel_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "verdigris/color/convert.h"
#include "verdigris/color/delta_e.h"
#include "verdigris/error.h"
#include "verdigris/files/testing.h"
#include "verdigris/metrics/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using testing::flat;
using testing::noise;

TEST(PixelErrors, OfAKnownOffset) {
    const auto a = flat(8, 5, {0.5f, 0.5f, 0.5f}), b = flat(8, 5, {0.75f, 0.5f, 0.25f});
    const double mse = mean_squared_error(a, b);
    EXPECT_DOUBLE_EQ(mse, 2 * 0.0625 / 3);
    EXPECT_DOUBLE_EQ(psnr_of(mse), 10 * std::log10(24.0));
    EXPECT_DOUBLE_EQ(psnr_of(0.01), 20);
}

TEST(PixelErrors, OfEqualPictures) {
    const auto a = noise(31, 9, 4);
    EXPECT_EQ(mean_squared_error(a, a), 0);
    EXPECT_EQ(psnr_of(0), std::numeric_limits<double>::infinity());
    EXPECT_EQ(color_difference(a, a).mean, 0);
    EXPECT_EQ(color_difference(a, a).percentile95, 0);
}

TEST(PixelErrors, LimitToTheUnitRange) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto a = flat(3, 3, {1.5f, -2, nan}), b = flat(3, 3, {1, 0, 0});
    EXPECT_EQ(mean_squared_error(a, b), 0);
    EXPECT_EQ(color_difference(a, b).mean, 0);
}

// 100 pixels, of which 5 or 6 differ by a known color: the 95th percentile is on the edge.
TEST(PixelErrors, NearestRank) {
    const SrgbF copper{0.72f, 0.45f, 0.36f}, brown{0.30f, 0.24f, 0.16f};
    const double e = delta_e2000(lab_from_srgb(copper), lab_from_srgb(brown));
    for (const int differing : {5, 6}) {
        const auto a = flat(10, 10, copper);
        auto b = flat(10, 10, copper);
        for (int i = 0; i < differing; ++i) b(i, 3) = brown;
        const ColorDifference d = color_difference(a, b);
        EXPECT_NEAR(d.mean, e * differing / 100, 1e-9);
        EXPECT_NEAR(d.percentile95, differing == 5 ? 0 : e, 1e-5);
    }
}

TEST(PixelErrors, SameAtAnyThreadCount) {
    const auto a = noise(70, 200, 1), b = noise(70, 200, 2);
    const double mse = mean_squared_error(a, b);
    const ColorDifference color = color_difference(a, b);
    set_thread_count(1);
    EXPECT_EQ(mean_squared_error(a, b), mse);
    EXPECT_EQ(color_difference(a, b).mean, color.mean);
    EXPECT_EQ(color_difference(a, b).percentile95, color.percentile95);
    set_thread_count(0);
}

TEST(PixelErrors, RefuseOtherSizes) {
    const auto a = flat(4, 5, {}), b = flat(5, 4, {});
    EXPECT_EQ(error_of([&] { mean_squared_error(a, b); }).code(), ErrorCode::bad_input);
    EXPECT_EQ(error_of([&] { color_difference(a, b); }).code(), ErrorCode::bad_input);
}

}  // namespace
}  // namespace verdigris
