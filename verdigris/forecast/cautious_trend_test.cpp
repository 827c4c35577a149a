// SPDX-License-Identifier: MIT
#include "verdigris/forecast/cautious_trend.h"

#include <gtest/gtest.h>

namespace verdigris {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Trend of_series(const VectorXd& increments, const TrendPrior& prior = {}) {
    return TrendModels(int(increments.size()), prior).trend(increments * increments.transpose(), 2);
}

TEST(CautiousTrend, IsShrunkByWhatItRisks) {
    Trend t;
    t.weights = MatrixXd::Constant(3, 1, 2);
    t.weights(1, 0) = 1;
    t.weights(2, 0) = 0;
    t.level = Eigen::RowVectorXd::Zero(1);
    t.change = VectorXd{{4, 1, 0}};
    t.error = VectorXd{{4, 0, 5}};
    be_cautious(t, MatrixXd::Identity(1, 1), 1);
    EXPECT_DOUBLE_EQ(t.weights(0, 0), 1);  // 4 / (4 + 4) of it
    EXPECT_DOUBLE_EQ(t.change[0], 1);
    EXPECT_DOUBLE_EQ(t.error[0], 5);       // and a quarter of 4 is forgone
    EXPECT_DOUBLE_EQ(t.weights(1, 0), 1);  // what is sure stays
    EXPECT_DOUBLE_EQ(t.weights(2, 0), 0);
    EXPECT_DOUBLE_EQ(t.error[2], 5);
}

TEST(CautiousTrend, NoiseIsTakenBackInFull) {
    // Values about a level, of models that know nothing else.
    const VectorXd values{{0.3, -0.5, 0.4, -0.2, 0.1, -0.4, 0.3, 0, 0.5}};
    const VectorXd d = values.tail(8) - values.head(8);
    TrendPrior still;
    still.drift = false;
    const Trend plain = of_series(d, still);
    Trend cautious = plain;
    be_cautious(cautious, d * d.transpose(), 10);
    const double back = plain.level.dot(d);
    EXPECT_NEAR(back, -0.4, 0.1);
    EXPECT_NEAR((cautious.weights * d)[0], back, 0.02);
    // All models together find some drift in it, and of that little is left.
    Trend t = of_series(d);
    const VectorXd before = t.weights * d;
    be_cautious(t, d * d.transpose(), 10);
    const VectorXd after = t.weights * d;
    const double level = t.level.dot(d);
    for (Eigen::Index u = 0; u < after.size(); ++u)
        EXPECT_LT(std::abs(after[u] - level), 0.5 * std::abs(before[u] - level) + 1e-12) << u;
}

TEST(CautiousTrend, WhatIsSureGoesOn) {
    VectorXd d(9);
    for (Eigen::Index i = 0; i < 9; ++i) d[i] = 1 + (i % 2 == 0 ? 0.01 : -0.01);
    const Trend plain = of_series(d);
    Trend t = plain;
    be_cautious(t, d * d.transpose(), 0.2);
    EXPECT_NEAR(t.weights.row(4).dot(d), plain.weights.row(4).dot(d), 0.1);  // of 5
    EXPECT_LE(t.weights.row(4).dot(d), plain.weights.row(4).dot(d));
    be_cautious(t = plain, d * d.transpose(), 0);
    EXPECT_EQ(t.weights, plain.weights);
    EXPECT_EQ(t.error, plain.error);
}

// A model's forecast is a drift that goes on and noise that goes away: of a series that is both,
// each part is what its own series gives.
TEST(CautiousTrend, TheLevelIsTheNoisesPart) {
    const VectorXd steady = VectorXd::Ones(9);
    EXPECT_NEAR(of_series(steady).level.dot(steady), 0, 0.05);
    VectorXd with_last_frame_off = steady;
    for (Eigen::Index i = 0; i < 9; ++i) with_last_frame_off[i] += 0.2 * (i % 2 == 0 ? 1 : -1);
    EXPECT_LT(of_series(with_last_frame_off).level.dot(with_last_frame_off), -0.05);
}

}  // namespace
}  // namespace verdigris
