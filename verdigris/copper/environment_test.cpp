// SPDX-License-Identifier: MIT
#include "verdigris/copper/environment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/copper/testing.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

TEST(Environment, AChamberIsConstant) {
    const Environment chamber(EnvironmentOptions::chamber(), 98.4);
    for (double t = -1; t < 120; t += 0.37) {
        EXPECT_EQ(chamber.at(t), 1);
        EXPECT_NEAR(chamber.exposure(t, t + 0.5), 0.5, 1e-12);
    }
}

TEST(Environment, NoiseHasTheSpreadAndTheMemoryAskedFor) {
    EnvironmentOptions options;
    options.noise = 0.2;  // 0 is five standard deviations away: no clamping
    options.correlation = 5;
    options.seed = 3;
    const double duration = 200000;  // 40000 correlation times
    const Environment air(options, duration);
    double sum = 0, squares = 0, lagged = 0;
    const int n = int(duration) - 10;
    for (int i = 0; i < n; ++i) {
        const double x = air.at(i) - 1;
        sum += x;
        squares += x * x;
        lagged += x * (air.at(i + 5) - 1);
    }
    // Standard errors with 2 T = 10 units per independent sample: 0.2 / sqrt(20000) for the mean,
    // sqrt(2 / 40000) for the variance.
    EXPECT_NEAR(sum / n, 0, 4 * 0.0015);
    EXPECT_NEAR(std::sqrt(squares / n), 0.2, 4 * 0.0008);
    EXPECT_NEAR(lagged / squares, std::exp(-1.0), 4 * 0.008);
    measured("pace of the air, standard deviation asked 0.2", std::sqrt(squares / n));
    measured("pace of the air, correlation after one time constant (0.368)", lagged / squares);
}

TEST(Environment, DaysComeAndGo) {
    EnvironmentOptions options;
    options.diurnal = 0.5;
    options.day = 10;
    const Environment days(options, 100);
    EXPECT_NEAR(days.at(2.5), 1.5, 1e-12);
    EXPECT_NEAR(days.at(7.5), 0.5, 1e-12);
    EXPECT_NEAR(days.exposure(0, 10), 10, 1e-10);
    // Half a day of sine: 5 + 0.5 * 10 / pi, up to straight lines 0.1 units long.
    EXPECT_NEAR(days.exposure(0, 5), 5 + 5 / 3.14159265358979, 1e-3);
}

TEST(Environment, PaceIsNeverNegativeAndExposureAddsUp) {
    EnvironmentOptions options = EnvironmentOptions::air(8);
    options.noise = 1.5;
    const Environment wild(options, 98.4);
    double total = 0;
    for (int i = 0; i < 984 * 3; ++i) {
        const double from = i / 30.0, to = (i + 1) / 30.0;
        EXPECT_GE(wild.at(from), 0);
        EXPECT_GE(wild.exposure(from, to), 0);
        total += wild.exposure(from, to);
    }
    EXPECT_NEAR(total, wild.exposure(0, 98.4), 1e-9);
}

TEST(Environment, SameSeedSameAirAndTheSameBeginning) {
    const Environment a(EnvironmentOptions::air(5), 50), b(EnvironmentOptions::air(5), 90),
        other(EnvironmentOptions::air(6), 50);
    double differs = 0;
    for (double t = 0; t <= 50; t += 0.7) {
        EXPECT_EQ(a.at(t), b.at(t));
        differs += std::abs(a.at(t) - other.at(t));
    }
    EXPECT_GT(differs, 1);
    EXPECT_NEAR(a.at(60), a.at(50), 1e-12);  // past its end: its last value
}

TEST(Environment, RefusesOptionsOutOfRange) {
    EnvironmentOptions options;
    options.noise = -0.1;
    EXPECT_EQ(error_of([&] { Environment air(options, 10); }).sentence(),
              "noise is -0.1; allowed are 0 to 2");
    EXPECT_EQ(error_of([&] { Environment air({}, -1); }).code(), ErrorCode::usage);
}

}  // namespace
}  // namespace verdigris
