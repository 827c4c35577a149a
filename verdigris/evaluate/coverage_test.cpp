// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace verdigris {
namespace {

constexpr int kSide = 120;

Spread planted(double common, double own) {
    Spread s;
    s.common = {1.5f, 1, 0.5f};
    s.own = Image<SrgbF>(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            if (x >= 20) s.own(x, y) = {x % 2 ? 0.5f : 1.5f, 1, 2};
    s.nodes = {{1, common, own}, {3, 3 * common, 3 * own}};
    return s;
}

TEST(Coverage, OfErrorsAsTheyWereStatedIsWhatWasStated) {
    const Spread spread = planted(0, 4e-4);
    Image<SrgbF> frame(kSide, kSide), truth(kSide, kSide), sd, scratch;
    spread_image(spread, 2, sd);  // half way: twice the first node's variance
    std::mt19937 random(3);
    // Student's t of 5 degrees of freedom has a variance of 5/3.
    std::student_t_distribution<float> student(5);
    const auto error = [&] { return std::sqrt(0.6f) * student(random); };
    for (std::size_t i = 0; i < frame.pixel_count(); ++i) {
        const SrgbF s = sd.pixels()[i];
        // What cannot move has no say, though it is far off.
        truth.pixels()[i] =
            s.r > 0 ? SrgbF{s.r * error(), s.g * error(), s.b * error()} : SrgbF{1, 1, 1};
    }
    EXPECT_NEAR(sd(21, 0).r, std::sqrt(8e-4 * 0.5), 1e-7);
    const Coverage c = coverage_of(spread, 2, frame, truth, weights_of({}, kSide, kSide), scratch);
    EXPECT_NEAR(c.pixels80, 0.80, 0.01);
    EXPECT_NEAR(c.pixels95, 0.95, 0.01);
}

TEST(Coverage, OfTheMeanColorIsByChannel) {
    const Spread spread = planted(1e-4, 0);
    Image<SrgbF> frame(kSide, kSide), truth(kSide, kSide), scratch;
    // Red lies 1.0, green 1.5 and blue 2.5 standard deviations off.
    for (SrgbF& p : truth.pixels())
        p = {float(1.0 * 0.01 * std::sqrt(1.5)), 0.015f, float(2.5 * 0.01 * std::sqrt(0.5))};
    const Coverage c = coverage_of(spread, 1, frame, truth, weights_of({}, kSide, kSide), scratch);
    EXPECT_NEAR(c.mean80, 1.0 / 3, 1e-12);
    EXPECT_NEAR(c.mean95, 2.0 / 3, 1e-12);
}

TEST(Coverage, IsNoNumberWhereNothingIsStated) {
    Image<SrgbF> frame(kSide, kSide), scratch;
    const Coverage c = coverage_of({}, 1, frame, frame, weights_of({}, kSide, kSide), scratch);
    EXPECT_TRUE(std::isnan(c.pixels80) && std::isnan(c.mean95));
}

TEST(Spread, IsLinearBetweenNodesAndHeldBeyond) {
    const Spread spread = planted(2e-4, 4e-4);
    EXPECT_NEAR(spread.at(0).common, 0, 1e-15);
    EXPECT_NEAR(spread.at(0.5).own, 2e-4, 1e-15);
    EXPECT_NEAR(spread.at(2).common, 4e-4, 1e-15);
    EXPECT_NEAR(spread.at(70).own, 12e-4, 1e-15);
    EXPECT_NEAR(spread_of_mean(spread, 1).r, std::sqrt(3e-4), 1e-7);
}

}  // namespace
}  // namespace verdigris
