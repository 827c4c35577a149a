// SPDX-License-Identifier: MIT
#include "verdigris/forecast/trend_outlook.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace verdigris {
namespace {

using Eigen::MatrixXd;

constexpr double kDoubt = 0.01;

/// Of frames that have a steady pace of this variance and white noise of that one.
Trend steady(int q, double pace, double noise, const TrendPrior& prior = {}) {
    MatrixXd gram = MatrixXd::Constant(q, q, pace);
    for (int i = 0; i < q; ++i) {
        gram(i, i) += 2 * noise;
        if (i > 0) gram(i, i - 1) -= noise, gram(i - 1, i) -= noise;
    }
    return TrendModels(q, prior).trend(gram, 100);
}

/// Mean over the next ten of the squared error of a straight line through n frames with white
/// noise: sigma^2 (1/n + (h + (n - 1)/2)^2 12 / (n (n^2 - 1))), the frame to come without noise.
double of_a_line(int n, double sigma2) {
    double sum = 0;
    for (int h = 1; h <= kOutlookUnits; ++h) {
        const double off = h + (n - 1) / 2.0;
        sum += sigma2 * (1.0 / n + 12 * off * off / (n * (double(n) * n - 1)));
    }
    return sum / kOutlookUnits;
}

double expected_error(const Trend& trend, double doubt, const Circumstances& circumstances) {
    return TrendOutlook(doubt).expected_error(trend, circumstances);
}

/// A steady pace of variance 1 may all the same be another one after a while: that no recording
/// tells (docs/models/bandtrend.md, how far off it may be).
double of_a_new_pace() {
    double sum = 0;
    for (int h = 1; h <= kOutlookUnits; ++h) sum += h * h * (1 - std::exp(-std::pow(h / 50.0, 3)));
    return sum / kOutlookUnits;
}

TEST(TrendOutlook, OfASteadyPaceUnderNoiseTheErrorFallsAsThatOfALine) {
    // One model, known: rho 1, no slowing, noise as large as the pace.
    Trend trend;
    trend.likely = {{{TrendShape::drift, false, 1, 0, 1}, 1, 1}};
    const auto known = [](int n) { return of_a_line(n, 1) + of_a_new_pace(); };
    for (const int n : {5, 10, 20, 40}) {
        const double expected = expected_error(trend, 0, {n - 1, 0, 1});
        // The pace has a prior here, and the line has none: better with few frames.
        EXPECT_LT(expected, known(n) * 1.02) << n;
        EXPECT_GT(expected, known(n) * (n < 10 ? 0.6 : 0.95)) << n;
    }
    // So the number of frames that halves its root is known.
    const double now = expected_error(trend, 0, {9, 0, 1});
    int n = 10, by_line = 10;
    while (expected_error(trend, 0, {n - 1, 0, 1}) > now / 4) ++n;
    while (known(by_line) > known(10) / 4) ++by_line;
    EXPECT_NEAR(n, by_line, 2);
    EXPECT_GT(n, 20);
}

TEST(TrendOutlook, FoundInTheIncrementsThatIsSeen) {
    TrendPrior one_part;
    one_part.two_parts = false;
    // What may be of two parts has more that is to be told apart, in as many increments.
    for (const auto& [prior, share] : {std::pair(one_part, 0.75), std::pair(TrendPrior{}, 0.8)}) {
        const Trend trend = steady(9, 1, 1, prior);
        const double now = expected_error(trend, kDoubt, {9, 0, 1});
        EXPECT_LT(expected_error(trend, kDoubt, {19, 0, 1}), share * now);
        EXPECT_LT(expected_error(trend, kDoubt, {9, 0, 0.25}), 0.75 * now);
        EXPECT_NEAR(frame_noise(trend), 1, 0.3);
    }
}

TEST(TrendOutlook, APartThatDiesAwayLeavesTheOther) {
    // Half of it steady, half of it falling to nothing: later on there is the steady half.
    TrendKind both{TrendShape::drift, false, 1, 0, 0.1};
    both.second_share = 0.5;
    both.second_kappa = 0.3;
    Trend trend, steady_half;
    trend.likely = {{both, 1, 2}};
    steady_half.likely = {{{TrendShape::drift, false, 1, 0, 0.2}, 1, 1}};
    EXPECT_NEAR(expected_error(trend, kDoubt, {9, 60, 1}),
                expected_error(steady_half, kDoubt, {9, 60, 1}), 1e-6);
    EXPECT_GT(expected_error(trend, kDoubt, {9, 0, 1}),
              1.1 * expected_error(steady_half, kDoubt, {9, 0, 1}));
}

TEST(TrendOutlook, NoRecordingForetellsARandomWalk) {
    for (const int q : {9, 19}) {
        const Trend trend = TrendModels(q).trend(MatrixXd::Identity(q, q), 100);
        const double now = expected_error(trend, kDoubt, {q, 0, 1});
        EXPECT_NEAR(now, 5.5, 0.8);  // the mean of 1 to 10 steps of variance 1
        EXPECT_GT(expected_error(trend, kDoubt, {39, 0, 1}), 0.97 * now);
        EXPECT_GT(expected_error(trend, kDoubt, {q, 0, 0.25}), 0.9 * now);
        EXPECT_LT(frame_noise(trend), 0.1);
    }
}

TEST(TrendOutlook, WhatDiesAwayIsEasierLaterOn) {
    // A random walk whose steps shrink by a tenth per unit.
    const int q = 19;
    MatrixXd gram = MatrixXd::Zero(q, q);
    for (int i = 0; i < q; ++i) gram(i, i) = std::exp(0.2 * (q - 1 - i));
    const Trend trend = TrendModels(q).trend(gram, 100);
    const double now = expected_error(trend, kDoubt, {q, 0, 1});
    EXPECT_NEAR(expected_error(trend, kDoubt, {q, 10, 1}) / now, std::exp(-2.0), 0.05);
}

TEST(TrendOutlook, MoreIsNeverWorse) {
    for (const double noise : {0.0, 0.1, 3.0}) {
        for (const double pace : {0.0, 0.5}) {
            const Trend trend = steady(7, pace + 1e-6, noise);
            double last = expected_error(trend, kDoubt, {7, 0, 1});
            EXPECT_GT(last, 0);
            for (int more = 1; more <= 32; more += 3) {
                const double now = expected_error(trend, kDoubt, {7 + more, double(more), 1});
                EXPECT_LE(now, last * (1 + 1e-9)) << noise << " " << pace << " " << more;
                last = now;
            }
            EXPECT_LE(expected_error(trend, kDoubt, {7, 0, 0.25}),
                      expected_error(trend, kDoubt, {7, 0, 1}) * (1 + 1e-9));
        }
    }
}

}  // namespace
}  // namespace verdigris
