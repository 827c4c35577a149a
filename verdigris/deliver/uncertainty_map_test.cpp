// SPDX-License-Identifier: MIT
#include "verdigris/deliver/uncertainty_map.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "verdigris/color/magma.h"
#include "verdigris/deliver/testing.h"
#include "verdigris/deliver/viewer_page.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Json = nlohmann::json;

/// Uneven channels, a law that grows, shares from 0.5 to 40 and a held border.
void make_unsure(MadeDelivery& made) {
    const int width = made.forecast.trajectory.base.width();
    const int height = made.forecast.trajectory.base.height();
    Spread& spread = made.forecast.spread;
    spread.common = {0.5f, 1.1f, 1.4f};
    spread.own = Image<SrgbF>(width, height);
    for (int y = 2; y < height - 2; ++y) {
        for (int x = 2; x < width - 2; ++x) {
            const float share = (x * 7 + y * 3) % 50 == 0 ? 40 : 0.5f + float((x + 3 * y) % 5);
            spread.own(x, y) = {share, 0.5f * share, 0.25f + float(x) / float(width)};
        }
    }
    spread.nodes = {{1, 1e-5, 4e-5}, {10, 2e-4, 5e-4}, {30, 1e-3, 2e-3}};
}

/// The half width as the header of Spread means it, through spread_image().
double expected(const Spread& spread, double horizon, int x, int y) {
    Image<SrgbF> sd;
    spread_image(spread, horizon, sd);
    const SrgbF c = sd(x, y);
    return kHalfWidth80 * std::sqrt((double(c.r) * double(c.r) + double(c.g) * double(c.g) +
                                     double(c.b) * double(c.b)) /
                                    3);
}

TEST(UncertaintyMap, IsTheRootMeanSquareOfTheSpread) {
    MadeDelivery made;
    make_unsure(made);
    const Spread& spread = made.forecast.spread;
    const Image<float> share = own_share(spread, {40, 24});
    for (const double horizon : {-3.0, 0.0, 0.4, 1.0, 7.0, 30.0, 80.0}) {
        const Image<float> map = half_width_map(spread, share, horizon);
        for (int y = 0; y < 24; ++y) {
            for (int x = 0; x < 40; ++x) {
                const double told = horizon > 0 ? expected(spread, horizon, x, y) : 0;
                ASSERT_NEAR(map(x, y), told, 1e-6) << horizon << ": " << x << ", " << y;
            }
        }
        EXPECT_EQ(map(20, 12) > 0, horizon > 0);
        EXPECT_EQ(map(1, 12), 0);
    }
}

TEST(UncertaintyMap, VariancesAverageAsVariancesOverWhatMoves) {
    Spread spread;
    spread.own = Image<SrgbF>(4, 4);
    const auto put = [&](int x, int y, float v) { spread.own(x, y) = {v, v, v}; };
    for (const int x : {0, 1}) put(x, 0, 1), put(x, 1, 9);  // of 1, 1, 9 and 9: 5
    put(2, 0, 4), put(3, 1, 8);                             // half of it moves, by 6
    put(0, 2, 7);                                           // a quarter: held
    spread.nodes = {{1, 0, 1e-4}};
    const Image<float> share = own_share(spread, {2, 2});
    EXPECT_FLOAT_EQ(share(0, 0), 5);
    EXPECT_FLOAT_EQ(share(1, 0), 6);
    EXPECT_EQ(share(0, 1), 0);
    EXPECT_EQ(share(1, 1), 0);
    // Not the mean of the widths, which would be 0.02 half widths.
    EXPECT_NEAR(half_width_map(spread, share, 1)(0, 0), kHalfWidth80 * 0.01 * std::sqrt(5.0), 1e-7);
    // What all share is not watered down by what is held beside it.
    spread.nodes = {{1, 1e-4, 0}};
    EXPECT_NEAR(half_width_map(spread, share, 1)(1, 0), kHalfWidth80 * 0.01, 1e-7);
    EXPECT_EQ(half_width_map(spread, share, 1)(0, 1), 0);
}

TEST(UncertaintyMap, ItsScaleIsRoundHoldsTheWorstHorizonAndIgnoresAFewPixels) {
    MadeDelivery made(50, 30);
    EXPECT_EQ(uncertainty_full_codes(made.delivery), 0);  // nothing is stated
    Spread& spread = made.forecast.spread;
    spread.own = Image<SrgbF>(50, 30);
    for (SrgbF& c : spread.own.pixels()) c = {1, 1, 1};
    const auto variance = [](double codes) {
        return codes * codes / (255 * 255 * kHalfWidth80 * kHalfWidth80);
    };
    const auto full = [&](double codes) {
        spread.nodes = {{5, 0, variance(codes)}, {20, 0, variance(codes / 2)}};
        return uncertainty_full_codes(made.delivery);
    };
    EXPECT_EQ(full(0.01), 1);
    EXPECT_EQ(full(3.9), 4);
    EXPECT_EQ(full(4.1), 5);
    EXPECT_EQ(full(11.9), 12);
    EXPECT_EQ(full(81), 100);
    for (int i = 0; i < 7; ++i) spread.own(i, 0) = {900, 900, 900};  // of 1500
    EXPECT_EQ(full(3.9), 4);
    // A horizon beyond twice the context counts up to four times the first, one within in full.
    made.delivery.horizons = {5, 20, 50};
    spread.nodes = {{5, 0, variance(2)}, {20, 0, variance(3)}, {50, 0, variance(7.5)}};
    EXPECT_EQ(uncertainty_full_codes(made.delivery), 8);
    spread.nodes[2].own = variance(70);
    EXPECT_EQ(uncertainty_full_codes(made.delivery), 8);
    spread.nodes[1].own = variance(12);
    EXPECT_EQ(uncertainty_full_codes(made.delivery), 12);
    made.delivery.horizons = {5, 20};
    for (int i = 7; i < 20; ++i) spread.own(i, 0) = {900, 900, 900};
    EXPECT_EQ(full(3.9), 120);
    for (SrgbF& c : spread.own.pixels()) c = {};
    EXPECT_EQ(full(3.9), 1);
}

TEST(UncertaintyMap, WhatIsHeldIsGrayAndNotSure) {
    Image<float> share(3, 1), width(3, 1);
    share(1, 0) = share(2, 0) = 1;
    width(2, 0) = 0.1f;
    const Image<SrgbU8> picture = uncertainty_picture(width, share, 0.1);
    EXPECT_EQ(picture(0, 0), kHeldGray);
    EXPECT_EQ(picture(1, 0), magma_table().front());
    EXPECT_EQ(picture(2, 0), magma_table().back());
    EXPECT_EQ(std::count(magma_table().begin(), magma_table().end(), kHeldGray), 0);
}

/// The half widths that a reader of the document computes: docs/VIEWER_DATA.md.
double read_half_width(const Json& spread, double root, double horizon) {
    double before[3] = {0, 0, 0}, at[2] = {0, 0};
    bool found = false;
    for (const Json& node : spread["nodes"]) {
        if (found) break;
        const double t = (horizon - before[0]) / (node[0].get<double>() - before[0]);
        found = horizon <= node[0];
        for (std::size_t k = 0; k < 2; ++k) {
            const double end = node[k + 1];
            at[k] = found ? before[k + 1] + t * (end - before[k + 1]) : end;
        }
        for (std::size_t k = 0; k < 3; ++k) before[k] = node[k];
    }
    const Json& c = spread["common"];
    const double mean = (c[0].get<double>() + c[1].get<double>() + c[2].get<double>()) / 3;
    return root > 0 ? kHalfWidth80 * std::sqrt(at[0] * mean + at[1] * root * root) : 0;
}

TEST(ViewerSpread, ReturnsEveryHalfWidthWithinAHundredthOfACode) {
    MadeDelivery made;
    make_unsure(made);
    made.forecast.spread.own(20, 12) = {1e-9f, 0, 0};  // next to nothing, yet it moves
    const Json document = Json::parse(viewer_json(made.delivery));
    const Json& spread = document["spread"];
    EXPECT_EQ(spread.size(), 4u);
    EXPECT_EQ(spread["full_codes"], uncertainty_full_codes(made.delivery));
    ASSERT_EQ(spread["own"]["channels"], 1);
    const std::vector<double> roots =
        decoded_blob(40, 24, 1, spread["own"]["scale"], spread["own"]["offset"],
                     spread["own"]["data"].get<std::string>());
    EXPECT_GT(roots[12 * 40 + 20], 0);
    double worst = 0;
    for (const double horizon : {0.5, 1.0, 12.0, 30.0, 31.0}) {
        for (int y = 0; y < 24; ++y) {
            for (int x = 0; x < 40; ++x) {
                const double got = read_half_width(spread, roots[std::size_t(y * 40 + x)], horizon);
                const double told = expected(made.forecast.spread, horizon, x, y);
                ASSERT_EQ(got > 0, told > 0) << x << ", " << y;
                // Twice the allowance where a pixel is kept from becoming 0.
                ASSERT_NEAR(255 * got, 255 * told, x == 20 && y == 12 ? 0.02 : 0.0101);
                worst = std::max(worst, 255 * std::abs(got - told));
            }
        }
    }
    EXPECT_GT(worst, 1e-4) << "steps as wide as allowed, or the page grows for nothing";
}

TEST(ViewerSpread, IsSmallerWithThePage) {
    MadeDelivery made(2048, 64);
    make_unsure(made);
    const Json spread = Json::parse(viewer_json(made.delivery))["spread"];
    const std::vector<double> roots =
        decoded_blob(1024, 32, 1, spread["own"]["scale"], spread["own"]["offset"],
                     spread["own"]["data"].get<std::string>());
    const Image<float> share = own_share(made.forecast.spread, {1024, 32});
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const double step = spread["own"]["scale"];
        ASSERT_NEAR(roots[i], std::sqrt(double(share.pixels()[i])), 0.51 * step);
    }
}

TEST(ViewerSpread, SameTextAtAnyThreadCount) {
    MadeDelivery made(300, 200);
    make_unsure(made);
    set_thread_count(1);
    const std::string one = viewer_json(made.delivery);
    set_thread_count(0);
    EXPECT_EQ(viewer_json(made.delivery), one);
}

// The page draws with a table of its own (apps/viewer/src/magma.ts).
TEST(ViewerSpread, TheColorsOfThePageAreThoseOfTheSheet) {
    if (!viewer_is_built_in()) GTEST_SKIP() << "this build has no viewer";
    std::string hex;
    for (const SrgbU8 c : magma_table()) {
        for (const int v : {int(c.r), int(c.g), int(c.b)}) {
            hex += "0123456789abcdef"[v / 16];
            hex += "0123456789abcdef"[v % 16];
        }
    }
    EXPECT_NE(viewer_page().find(hex), std::string_view::npos);
}

}  // namespace
}  // namespace verdigris
