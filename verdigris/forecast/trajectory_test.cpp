// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hwy/targets.h"
#include "verdigris/error.h"
#include "verdigris/forecast/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

struct Channel {
    double base, rate, curvature;
};

/// A trajectory whose red channel follows `c` and whose others rest at 0.5. Wide enough for a
/// vector and a tail.
Trajectory one_channel(Channel c, int order, int n, bool clamp = true) {
    Trajectory t;
    const auto flat = [](double r, double rest) {
        return paint(37, 3, [=](int, int) { return SrgbF{float(r), float(rest), float(rest)}; });
    };
    t.base = flat(c.base, 0.5);
    t.rate = flat(c.rate, 0);
    if (order == 2) t.curvature = flat(c.curvature, 0);
    t.law = {order, n};
    t.clamp = clamp;
    return t;
}

double red_at(const Trajectory& t, double h) {
    Image<SrgbF> out;
    evaluate_trajectory(t, h, out);
    for (const SrgbF& c : out.pixels()) EXPECT_EQ(c.r, out(0, 0).r);  // vector and tail agree
    return double(out(0, 0).r);
}

TEST(TimeLaw, IsZeroAtZeroAndMatchesTheSquareLaw) {
    const TimeLaw law{2, 5};
    EXPECT_EQ(law.phi(0), 0);
    EXPECT_EQ(law.phi2(0), 0);
    EXPECT_DOUBLE_EQ(law.phi(3), 3);
    EXPECT_DOUBLE_EQ(law.phi2(3), 7 * 7 - 4 * 4);
    EXPECT_EQ((TimeLaw{1, 5}).phi2(3), 0);
    EXPECT_EQ((TimeLaw{0, 5}).phi(3), 0);
}

TEST(Trajectory, MovesLinearlyUntilItsEdge) {
    const Trajectory up = one_channel({0.9, 0.02, 0}, 1, 5);
    EXPECT_NEAR(red_at(up, 4), 0.98, 1e-6);
    EXPECT_NEAR(red_at(up, 5), 1.0, 1e-6);
    EXPECT_NEAR(red_at(up, 50), 1.0, 1e-6);
    const Trajectory down = one_channel({0.1, -0.05, 0}, 1, 5);
    EXPECT_NEAR(red_at(down, 1), 0.05, 1e-6);
    EXPECT_NEAR(red_at(down, 50), 0.0, 1e-6);
    EXPECT_GE(red_at(down, 50), 0.0);
}

TEST(Trajectory, WithoutClampLeavesTheRange) {
    EXPECT_NEAR(red_at(one_channel({0.9, 0.02, 0}, 1, 5, false), 50), 1.9, 1e-5);
}

TEST(Trajectory, FreezesTheWholePixelAtTheFirstChannel) {
    Trajectory t = one_channel({0.9, 0.02, 0}, 1, 5);
    t.rate = paint(37, 3, [](int, int) { return SrgbF{0.02f, -0.01f, 0.03f}; });
    Image<SrgbF> out;
    evaluate_trajectory(t, 30, out);  // red leaves first, at 5
    EXPECT_NEAR(out(0, 0).r, 1.0, 1e-6);
    EXPECT_NEAR(out(0, 0).g, 0.45, 1e-6);
    EXPECT_NEAR(out(0, 0).b, 0.65, 1e-6);
}

TEST(Trajectory, AtTheEdgeOutwardFreezesAndInwardIsFree) {
    EXPECT_EQ(red_at(one_channel({1, 0.1, 0}, 1, 5), 3), 1.0);
    EXPECT_EQ(red_at(one_channel({0, -0.1, 0}, 1, 5), 3), 0.0);
    EXPECT_NEAR(red_at(one_channel({1, -0.1, 0}, 1, 5), 3), 0.7, 1e-6);
    EXPECT_NEAR(red_at(one_channel({0, 0.1, 0}, 1, 5), 3), 0.3, 1e-6);
    // Order 2 with n = 1, so that phi2 = h^2 and rate is the speed at 0.
    EXPECT_EQ(red_at(one_channel({1, 0, 0.1}, 2, 1), 3), 1.0);
    EXPECT_EQ(red_at(one_channel({1, 0.1, -0.5}, 2, 1), 3), 1.0);
    EXPECT_NEAR(red_at(one_channel({1, -0.1, 0}, 2, 1), 3), 0.7, 1e-6);
    EXPECT_NEAR(red_at(one_channel({1, 0, -0.05}, 2, 1), 3), 0.55, 1e-6);
    EXPECT_NEAR(red_at(one_channel({0, 0, 0}, 2, 1), 3), 0.0, 0);
}

/// The first step on a fine grid at which the pixel is outside; a slow oracle for the clamp.
double first_exit(const Channel& c, int n, double limit) {
    const TimeLaw law{2, n};
    for (double h = 0; h <= limit; h += 1e-3) {
        const double v = c.base + law.phi(h) * c.rate + law.phi2(h) * c.curvature;
        if (v < -1e-9 || v > 1 + 1e-9) return h;
    }
    return std::numeric_limits<double>::infinity();
}

TEST(Trajectory, QuadraticClampMatchesASlowSearch) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1), sign(-1, 1);
    int left = 0, came_back = 0;
    for (int i = 0; i < 300; ++i) {
        const int n = 1 + i % 12;
        const Channel c{double(float(unit(random))), double(float(0.08 * sign(random))),
                        double(float(0.004 * sign(random)))};
        const double exit = first_exit(c, n, 40);
        const Trajectory t = one_channel(c, 2, n);
        for (double h : {0.5, 5.0, 39.0}) {
            const double at = std::min(h, exit);
            const double expected = c.base + t.law.phi(at) * c.rate + t.law.phi2(at) * c.curvature;
            EXPECT_NEAR(red_at(t, h), std::clamp(expected, 0.0, 1.0), 1e-3) << i << " " << h;
        }
        left += std::isfinite(exit);
        came_back += (c.rate + 2 * (n - 1) * c.curvature) * c.curvature < 0 && std::isfinite(exit);
    }
    EXPECT_GT(left, 100);
    EXPECT_GT(came_back, 20);  // turned inside the range, then left on the other side
}

TEST(Trajectory, IsContinuousInTheHorizonAndStaysInRange) {
    Trajectory t;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1), sign(-1, 1);
    t.base = paint(64, 8, [&](int, int) {
        return SrgbF{unit(random), unit(random), unit(random)};
    });
    t.rate = paint(64, 8, [&](int, int) {
        return SrgbF{0.02f * sign(random), 0.02f * sign(random), 0.02f * sign(random)};
    });
    t.curvature = paint(64, 8, [&](int, int) {
        return SrgbF{1e-3f * sign(random), 1e-3f * sign(random), 1e-3f * sign(random)};
    });
    for (int order : {1, 2}) {
        t.law = {order, 10};
        Image<SrgbF> before, now;
        evaluate_trajectory(t, 0, before);
        EXPECT_TRUE(same_bytes(before, t.base));
        for (double h = 0.01; h < 60; h += 0.01 + h / 50) {
            const double step = 0.01;
            evaluate_trajectory(t, h, before);
            evaluate_trajectory(t, h + step, now);
            EXPECT_LE(largest_difference(before, now),
                      step * (0.02 + 1e-3 * (18 + 2 * h + 1)) + 1e-6);
            for (const SrgbF& c : now.pixels()) {
                ASSERT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1);
            }
        }
    }
}

TEST(Trajectory, SameBytesOnAnyNumberOfThreads) {
    const Context context = drifting(6, planted_drift(), 0.01, 3, 300, 200);
    const Forecast forecast = affinergb().forecast(context);
    set_thread_count(1);
    const Image<SrgbF> one = forecast.at(20);
    const Forecast again = affinergb().forecast(context);
    set_thread_count(0);
    EXPECT_TRUE(same_bytes(one, forecast.at(20)));
    EXPECT_TRUE(same_bytes(again.trajectory.rate, forecast.trajectory.rate));
}

TEST(Trajectory, EveryInstructionSetGivesTheSameForecast) {
    const Context context = drifting(6, planted_drift(), 0.01, 3, 45, 31);
    const AffineOptions options{AffineFamily::full, 2};
    const Image<SrgbF> best = affinergb(options).forecast(context).at(9);
    int targets = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_LT(largest_difference(affinergb(options).forecast(context).at(9), best), 1e-5)
            << hwy::TargetName(target);
        ++targets;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(targets, 1);
}

TEST(OutOfGamut, CountsPixelsOfTheUnclampedFrame) {
    Trajectory t = one_channel({0.9, 0, 0}, 1, 5);
    t.rate(0, 0) = {0.02f, 0, 0};   // out after 5
    t.rate(1, 0) = {0, -0.06f, 0};  // out after 8.3
    const double pixel = 1.0 / (37 * 3);
    EXPECT_EQ(out_of_gamut_share(t, 4, {}), 0);
    EXPECT_DOUBLE_EQ(out_of_gamut_share(t, 6, {}), pixel);
    EXPECT_DOUBLE_EQ(out_of_gamut_share(t, 9, {}), 2 * pixel);
    EXPECT_DOUBLE_EQ(out_of_gamut_share(t, 9, {}, 0.05), pixel);
    Mask where(37, 3);
    where(1, 0) = kInside;
    EXPECT_DOUBLE_EQ(out_of_gamut_share(t, 9, where), 1);
}

TEST(Trajectory, RefusesWhatMakesNoSense) {
    Trajectory t = one_channel({0.5, 0, 0}, 1, 5);
    Image<SrgbF> out;
    EXPECT_THROW(evaluate_trajectory(t, -1, out), Error);
    EXPECT_THROW(evaluate_trajectory(t, std::nan(""), out), Error);
    t.rate = Image<SrgbF>(2, 2);
    EXPECT_THROW(evaluate_trajectory(t, 1, out), Error);
    EXPECT_THROW(out_of_gamut_share(one_channel({0.5, 0, 0}, 1, 5), 1, Mask(2, 2)), Error);
}

TEST(Trajectory, ALawWithNodesIsLinearBetweenThem) {
    TimeLaw law{2, 5, {{1, 0.5, -1}, {3, 1.5, 1}}};
    EXPECT_EQ(law.phi(0), 0);
    EXPECT_EQ(law.phi(0.5), 0.25);
    EXPECT_EQ(law.phi2(2), 0);
    EXPECT_EQ(law.phi(3), 1.5);
    EXPECT_EQ(law.phi2(100), 1);
}

TEST(Trajectory, ALawWithNodesIsShortenedIntoTheRange) {
    for (const bool clamp : {true, false}) {
        Trajectory t;
        t.base = paint(19, 3, [](int, int) { return SrgbF{0.5f, 0.8f, 0.2f}; });
        t.rate = paint(19, 3, [](int, int) { return SrgbF{0.1f, 0.2f, 0.0f}; });
        t.curvature = paint(19, 3, [](int, int) { return SrgbF{0.0f, 0.0f, 0.1f}; });
        t.law = {2, 5, {{1, 1, 1}, {4, 2, 2}}};
        t.clamp = clamp;
        Image<SrgbF> out;
        evaluate_trajectory(t, 4, out);
        const float share = clamp ? 0.5f : 1.0f;  // green reaches 1 half way
        for (const SrgbF& c : out.pixels()) {
            EXPECT_NEAR(c.r, 0.5f + share * 0.2f, 1e-6);
            EXPECT_NEAR(c.g, 0.8f + share * 0.4f, 1e-6);
            EXPECT_NEAR(c.b, 0.2f + share * 0.2f, 1e-6);
        }
        EXPECT_EQ(out_of_gamut_share(t, 4, Mask()), 1);
        EXPECT_EQ(out_of_gamut_share(t, 0.5, Mask()), 0);
    }
}

}  // namespace
}  // namespace verdigris
