// SPDX-License-Identifier: MIT
#include "verdigris/forecast/trend_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace verdigris {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kTenUnits = 9, kHundredUnits = int(kTrendUnits.size()) - 1;

/// Of one series that every pixel follows.
Trend of_series(const VectorXd& increments, double count = 30) {
    return TrendModels(int(increments.size())).trend(increments * increments.transpose(), count);
}

TEST(TrendModels, ASteadyDriftGoesOnAndSlowsDown) {
    const VectorXd d = VectorXd::Ones(4);
    const VectorXd ahead = of_series(d).weights * d;
    EXPECT_NEAR(ahead[0], 1, 0.05);
    EXPECT_GT(ahead[kTenUnits], 7);
    EXPECT_LT(ahead[kTenUnits], 10.1);
    for (Eigen::Index u = 1; u < ahead.size(); ++u) EXPECT_GE(ahead[u], ahead[u - 1]);
    EXPECT_LT(ahead[kHundredUnits], 80);
}

TEST(TrendModels, WithoutDriftsALevelWandersOrIsNoisy) {
    TrendPrior light;
    light.drift = false;
    const auto ahead = [&](const VectorXd& d) -> VectorXd {
        return TrendModels(int(d.size()), light).trend(d * d.transpose(), 1).weights * d;
    };
    // A ramp is not carried on, and little of it is taken for noise.
    const VectorXd ramp = ahead(VectorXd::Ones(9));
    EXPECT_LE(ramp.maxCoeff(), 0);
    EXPECT_GT(ramp.minCoeff(), -0.75);
    // Of noise about a level, the last value goes back to the level: 0.45 below it.
    const VectorXd values{{0.3, -0.5, 0.4, -0.2, 0.1, -0.4, 0.3, 0, 0.5}};
    const VectorXd noise = ahead(values.tail(8) - values.head(8));
    EXPECT_NEAR(noise[0], -0.4, 0.1);
    EXPECT_NEAR(noise[kTenUnits], noise[0], 0.05);  // and stays there
}

TEST(TrendModels, ADriftThatDiesAwayIsSeenToDoSo) {
    VectorXd d(4);
    for (int i = 0; i < 4; ++i) d[i] = std::exp(-0.5 * i);
    double truth = 0;
    for (int i = 4; i < 14; ++i) truth += std::exp(-0.5 * i);
    const VectorXd ahead = of_series(d).weights * d;
    EXPECT_NEAR(ahead[kTenUnits], truth, 0.35 * truth);
}

TEST(TrendModels, ABendIsFollowed) {
    // Increments that grow as those of a parabola do.
    VectorXd d(9);
    for (int i = 0; i < 9; ++i) d[i] = 1 + 0.2 * i;
    const VectorXd ahead = of_series(d).weights * d;
    EXPECT_NEAR(ahead[0], 2.8, 0.15);
    EXPECT_GT(ahead[4], 5 * 2.7);  // units 1 to 5, if the last increment just went on: 13
}

TEST(TrendModels, WhatSpeedsUpDoesNotDoSoForEver) {
    const auto size = [](double kappa, double ahead) {
        return drift_size({TrendShape::drift, false, 1, kappa}, ahead);
    };
    EXPECT_DOUBLE_EQ(size(-0.1, 2), std::exp(0.2));
    EXPECT_DOUBLE_EQ(size(-0.1, 50), size(-0.1, 3));
    EXPECT_DOUBLE_EQ(size(-0.1, -5), std::exp(-0.5));
    EXPECT_DOUBLE_EQ(size(0.1, 50), std::exp(-5));
}

TEST(TrendModels, TwoPartsEachGoOnInTheirOwnWay) {
    // Of each pixel a part that goes on and one that dies away or has begun to spread.
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (const double kappa : {0.3, -0.1}) {
        const int q = 4, ahead = 10;
        MatrixXd parts(q, 2);
        Eigen::Vector2d truth(ahead, 0);
        const TrendKind second{TrendShape::drift, false, 1, kappa};
        for (int i = 0; i < q; ++i) parts.row(i) << 1, drift_size(second, i - q + 1);
        for (int h = 1; h <= ahead; ++h) truth[1] += drift_size(second, h);
        MatrixXd gram = MatrixXd::Zero(q, q);
        MatrixXd amounts(2, 3000);
        for (Eigen::Index pixel = 0; pixel < amounts.cols(); ++pixel) {
            amounts.col(pixel) << normal(random), normal(random);
            const VectorXd d = parts * amounts.col(pixel);
            gram += d * d.transpose() / double(amounts.cols());
        }
        gram += 1e-5 * MatrixXd::Identity(q, q);
        TrendPrior none;
        none.two_parts = false;
        const auto error = [&](const TrendPrior& prior) {
            const Trend trend = TrendModels(q, prior).trend(gram, 100);
            return (trend.weights.row(kTenUnits) * parts * amounts - truth.transpose() * amounts)
                       .squaredNorm() /
                   (truth.transpose() * amounts).squaredNorm();
        };
        EXPECT_LT(error({}), 0.02) << kappa;
        // A bend does for what speeds up a little, and not for what dies away beside what does not.
        if (kappa > 0) {
            EXPECT_GT(error(none), 2 * error({}));
        }
    }
}

/// Gram of many series of increments, and the mean square error over ten units of what the trend
/// says of them, of what it is where nothing is forecast.
double left_at_ten(const TrendPrior& prior, const std::function<VectorXd(std::mt19937&)>& series,
                   int q) {
    std::mt19937 random(17);
    std::vector<VectorXd> all;
    MatrixXd gram = MatrixXd::Zero(q, q);
    for (int pixel = 0; pixel < 3000; ++pixel) {
        all.push_back(series(random));
        gram += all.back().head(q) * all.back().head(q).transpose() / 3000;
    }
    const Trend trend = TrendModels(q, prior).trend(gram, 100);
    double error = 0, still = 0;
    for (const VectorXd& d : all) {
        const double truth = d.segment(q, 10).sum();
        error += std::pow(trend.weights.row(kTenUnits).dot(d.head(q)) - truth, 2);
        still += truth * truth;
    }
    return error / still;
}

TEST(TrendModels, ADriftThatWalksKeepsWhatItHasGot) {
    // Places that begin to change one after another, and then go on.
    const int q = 4;
    const auto series = [](std::mt19937& random) {
        std::normal_distribution<double> normal;
        VectorXd d(q + 10);
        double pace = 0;
        for (double& v : d) v = pace += normal(random);
        return d;
    };
    // The best there is carries the last increment on; what then comes, nothing foretells.
    double best = 0, still = 0;
    for (int h = 1; h <= 10; ++h) best += h * h;
    still = best + 100 * q;
    TrendPrior none;
    none.walking = false;
    EXPECT_LT(left_at_ten({}, series, q), 1.03 * best / still);
    EXPECT_GT(left_at_ten(none, series, q), 1.1 * best / still);
}

TEST(TrendModels, ALayerGrowsWithTheSquareRootOfItsAge) {
    for (const double age : {2.0, 10.0}) {
        const auto series = [age](std::mt19937& random) {
            VectorXd d(19);
            const double size = std::normal_distribution<double>()(random);
            std::normal_distribution<double> noise(0, 0.002);
            for (int i = 0; i < 19; ++i)
                d[i] = size * (std::sqrt(age + i + 1) - std::sqrt(age + i)) + noise(random);
            return d;
        };
        EXPECT_LT(left_at_ten({}, series, 9), 0.01) << age;  // doubt alone is .0025
    }
    TrendKind layer{TrendShape::drift, false, 1};
    layer.age = 4;
    EXPECT_DOUBLE_EQ(drift_size(layer, 12), 0.5);
    EXPECT_DOUBLE_EQ(drift_size(layer, -3), 2);
    EXPECT_DOUBLE_EQ(drift_size(layer, -90), std::sqrt(8));  // not younger than new
}

TEST(TrendModels, NoiseIsTakenBackAndNotCarriedOn) {
    // Many pixels of one level each, and white noise.
    const int n = 6;
    std::mt19937 random(7);
    std::normal_distribution<double> noise;
    MatrixXd gram = MatrixXd::Zero(n - 1, n - 1);
    std::vector<VectorXd> changes;
    std::vector<double> truths;
    for (int pixel = 0; pixel < 4000; ++pixel) {
        VectorXd e(n);
        for (double& v : e) v = noise(random);
        const VectorXd d = e.tail(n - 1) - e.head(n - 1);
        gram += d * d.transpose() / 4000;
        changes.push_back(d);
        truths.push_back(-e[n - 1]);
    }
    const Trend trend = TrendModels(n - 1).trend(gram, 100);
    for (const int unit : {0, kTenUnits, kHundredUnits}) {
        double ours = 0, still = 0;
        for (std::size_t i = 0; i < changes.size(); ++i) {
            const double error = trend.weights.row(unit).dot(changes[i]) - truths[i];
            ours += error * error;
            still += truths[i] * truths[i];
        }
        EXPECT_LT(ours, 0.35 * still) << unit;  // the mean of six frames leaves 1/6
    }
}

TEST(TrendModels, AStepIsNotCarriedOn) {
    for (int at = 0; at < 9; ++at) {
        VectorXd d = 1e-3 * VectorXd::Ones(9);
        d[at] = 1;
        const Trend trend = of_series(d);
        EXPECT_GT(trend.event, 0.9) << at;
        if (!trend.outlier) {
            EXPECT_EQ(trend.event_frame, at + 1);
        }
        EXPECT_NEAR((trend.weights * d)[kTenUnits], 0.008, 0.03) << at;
    }
}

TEST(TrendModels, AStepWithinTheTimeOfAFrameIsNotCarriedOnEither) {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 0.003);
    for (const double share : {0.1, 0.3, 0.5, 0.8}) {
        for (int at = 1; at < 9; ++at) {
            VectorXd d(9);
            for (double& v : d) v = noise(random);
            d[at - 1] += share, d[at] += 1 - share;
            const Trend trend = of_series(d);
            EXPECT_GT(trend.event, 0.9) << at << " " << share;
            EXPECT_NEAR((trend.weights * d)[kTenUnits], 0, 0.1) << at << " " << share;
        }
    }
    // Four increments that rise by steady halves are no step.
    const VectorXd d = VectorXd::Ones(4);
    EXPECT_LT(of_series(d).event, 0.5);
}

TEST(TrendModels, WhatSwingsSwingsBack) {
    // Twelve increments of a level that goes to and fro in eight units, and its next ten.
    const auto level = [](double t) { return std::sin(2 * std::numbers::pi * t / 8); };
    VectorXd d(12);
    for (int i = 0; i < 12; ++i) d[i] = level(i + 1) - level(i);
    TrendPrior none;
    none.swing = false;
    const VectorXd ahead = of_series(d).weights * d;
    const VectorXd without = TrendModels(12, none).trend(d * d.transpose(), 30).weights * d;
    double error = 0, error_without = 0, change = 0;
    for (int u = 0; u <= kTenUnits; ++u) {
        const double truth = level(13 + u) - level(12);
        error += (ahead[u] - truth) * (ahead[u] - truth);
        error_without += (without[u] - truth) * (without[u] - truth);
        change += truth * truth;
    }
    EXPECT_LT(error, 0.2 * change);
    EXPECT_GT(error_without, 10 * error);  // its bend goes on
}

TEST(TrendModels, AnOutlyingFrameIsSetAside) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 0.01), flash;
    for (int at = 1; at < 9; ++at) {
        std::vector<VectorXd> pixels;
        MatrixXd gram = MatrixXd::Zero(9, 9);
        for (int pixel = 0; pixel < 100; ++pixel) {
            VectorXd d(9);
            for (double& v : d) v = noise(random);
            const double size = flash(random);
            d[at - 1] += size, d[at] -= size;
            gram += d * d.transpose() / 100;
            pixels.push_back(std::move(d));
        }
        const Trend trend = TrendModels(9).trend(gram, 100);
        EXPECT_GT(trend.event, 0.9) << at;
        EXPECT_TRUE(trend.outlier) << at;
        EXPECT_EQ(trend.event_frame, at);
        double square = 0;
        for (const VectorXd& d : pixels) square += std::pow(trend.weights.row(kTenUnits).dot(d), 2);
        EXPECT_LT(std::sqrt(square / 100), 0.02) << at;
    }
}

TEST(TrendModels, StatesTheErrorThatNoiseAndARandomWalkHave) {
    constexpr int q = 9;
    MatrixXd noise = 2 * MatrixXd::Identity(q, q);
    for (int i = 0; i + 1 < q; ++i) noise(i, i + 1) = noise(i + 1, i) = -1;
    // A frame to come differs from the mean of n by its own noise and the mean's.
    const Trend still = TrendModels(q).trend(noise, 100);
    EXPECT_NEAR(still.error[0], 1.1, 0.15);
    EXPECT_NEAR(still.error[kHundredUnits], 1.1, 0.5);
    // A walk is off by one step's variance per unit, give or take what is taken for a drift.
    const Trend walk = TrendModels(q).trend(MatrixXd::Identity(q, q), 100);
    EXPECT_NEAR(walk.error[0], 1, 0.2);
    EXPECT_GT(walk.error[kTenUnits], 8);
    EXPECT_LT(walk.error[kTenUnits], 25);
    // A steady drift without noise is sure of the next unit and of little in a hundred.
    const Trend steady = of_series(VectorXd::Ones(q));
    EXPECT_LT(std::sqrt(steady.error[0]), 0.05);
    EXPECT_GT(std::sqrt(steady.error[kHundredUnits]), 20);
    EXPECT_LT(steady.change[0], 1.1);
}

TEST(TrendModels, TheUnitOfColorDoesNotMatter) {
    VectorXd d(4);
    d << 1, 0.8, 0.9, 0.7;
    const MatrixXd one = of_series(d).weights, tiny = of_series(1e-7 * d).weights;
    EXPECT_LT((one - tiny).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(TrendModels, OneIncrementIsEnoughToAnswer) {
    const VectorXd d = VectorXd::Ones(1);
    const VectorXd ahead = of_series(d, 2).weights * d;
    EXPECT_TRUE(ahead.allFinite());
    EXPECT_LT(std::abs(ahead[0]), 1);  // of one increment it cannot know that it goes on
}

}  // namespace
}  // namespace verdigris
