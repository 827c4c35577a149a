// SPDX-License-Identifier: MIT
#include "verdigris/copper/growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "verdigris/copper/testing.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

GrowthLaw law_of(double kp, ThinFilmLaw thin = ThinFilmLaw::direct_logarithmic) {
    GrowthOptions options;
    options.parabolic_rate = kp;
    options.thin_film = thin;
    return GrowthLaw(options);
}

constexpr ThinFilmLaw kThinLaws[] = {ThinFilmLaw::direct_logarithmic,
                                     ThinFilmLaw::inverse_logarithmic};

// Fourth-order Runge-Kutta on nothing but rate().
double runge_kutta(const GrowthLaw& law, double nm, double exposure, int steps) {
    const double h = exposure / steps;
    for (int i = 0; i < steps; ++i) {
        const double a = law.rate(nm), b = law.rate(nm + h / 2 * a), c = law.rate(nm + h / 2 * b),
                     d = law.rate(nm + h * c);
        nm += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return nm;
}

TEST(Growth, RatesJoinAtTheBordersAndNeverRise) {
    for (const ThinFilmLaw thin : kThinLaws) {
        const GrowthLaw law = law_of(2, thin);
        for (const double border : {5.0, 25.0}) {
            const double below = law.rate(border * (1 - 1e-12)), above = law.rate(border);
            EXPECT_NEAR(below / above, 1, 1e-11);
        }
        double before = std::numeric_limits<double>::infinity();
        for (double nm = 0.01; nm < 60; nm += 0.01) {
            EXPECT_LE(law.rate(nm), before);
            before = law.rate(nm);
        }
        EXPECT_EQ(law.rate(25), 2.0 / 50);
        EXPECT_NEAR(law.rate(5), 37.5 * 2 / 75, 1e-15);
    }
}

TEST(Growth, ParabolicRegimeIsASquareRoot) {
    const GrowthLaw law = law_of(3);
    EXPECT_NEAR(law.grow(25, 100), std::sqrt(625 + 300.0), 1e-13);
    EXPECT_NEAR(law.grow(300, 7), std::sqrt(90000 + 21.0), 1e-12);
}

TEST(Growth, CubicRegimeIsACubeRoot) {
    const GrowthLaw law = law_of(3);
    EXPECT_NEAR(law.grow(5, 100), std::cbrt(125 + 37.5 * 3 * 100), 1e-13);
    EXPECT_NEAR(law.grow(10, 1), std::cbrt(1000 + 112.5), 1e-13);
}

TEST(Growth, ThinRegimeIsALogarithm) {
    // dL/dt = a e^{-L/b} integrates to L = b ln(e^{L0/b} + a t / b).
    const GrowthLaw law = law_of(0.01);
    const double a = 0.5 * 0.01 * std::exp(5 / 1.5);
    for (const double start : {0.0, 1.0, 3.0}) {
        const double expected = 1.5 * std::log(std::exp(start / 1.5) + a * 2 / 1.5);
        EXPECT_NEAR(law.grow(start, 2), expected, 1e-13);
    }
}

TEST(Growth, InverseLogarithmicRegimeFollowsCabreraAndMott) {
    const GrowthLaw law = law_of(0.01, ThinFilmLaw::inverse_logarithmic);
    EXPECT_NEAR(law.grow(1, 20), runge_kutta(law, 1, 20, 400000), 1e-8);
    EXPECT_NEAR(law.grow(2.5, 20), runge_kutta(law, 2.5, 20, 40000), 1e-11);
    // From a bare surface: infinitely fast at first, and yet thin. Checked through its own clock
    // by quadrature, because no stepper survives the start.
    const double end = law.grow(0, 30);
    double clock = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) clock += 1 / law.rate(end * (i + 0.5) / n) * end / n;
    EXPECT_NEAR(clock, 30, 1e-6);
    EXPECT_TRUE(end > 1 && end < 5) << end;
}

TEST(Growth, CompositionAcrossBordersIsWhatFineStepsGive) {
    double worst = 0;
    for (const ThinFilmLaw thin : kThinLaws) {
        const GrowthLaw law = law_of(20, thin);
        const double across = law.exposure_between(4, 32);  // both borders in one go
        const double fine = runge_kutta(law, 4, across, 4000000);
        worst = std::max({worst, std::abs(fine - 32), std::abs(law.grow(4, across) - 32)});
        const double inside = law.exposure_between(3, 7);
        worst = std::max(worst, std::abs(runge_kutta(law, 3, inside, 400000) - 7));
    }
    measured("growth across borders against Runge-Kutta, largest difference in nm", worst);
    EXPECT_LT(worst, 1e-9);
}

TEST(Growth, HalfStepsCompose) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    double worst = 0;
    for (const ThinFilmLaw thin : kThinLaws) {
        const GrowthLaw law = law_of(0.34, thin);
        for (int i = 0; i < 20000; ++i) {
            const double start = 40 * unit(random) * unit(random);
            const double exposure = std::pow(10, 6 * unit(random) - 2), part = unit(random);
            const double whole = law.grow(start, exposure);
            const double halves = law.grow(law.grow(start, part * exposure), (1 - part) * exposure);
            worst = std::max(worst, std::abs(whole - halves) / whole);
        }
    }
    measured("growth in one step against two, largest relative difference", worst);
    EXPECT_LT(worst, 1e-12);
}

TEST(Growth, ExposureIsTheInverseOfGrowth) {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const ThinFilmLaw thin : kThinLaws) {
        const GrowthLaw law = law_of(0.34, thin);
        for (int i = 0; i < 20000; ++i) {
            const double from = 40 * unit(random), to = from + 30 * unit(random);
            EXPECT_NEAR(law.grow(from, law.exposure_between(from, to)), to, 1e-11);
        }
        EXPECT_EQ(law.exposure_between(7, 7), 0);
        EXPECT_EQ(law.exposure_between(7, 6), 0);
    }
}

TEST(Growth, ThicknessNeverDecreases) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const ThinFilmLaw thin : kThinLaws) {
        const GrowthLaw law = law_of(0.34, thin);
        for (int i = 0; i < 20000; ++i) {
            const double start = i % 4 == 0 ? 5 * (i % 8 == 0) : 60 * unit(random);
            const double tiny = std::pow(10, -20 * unit(random));
            const double a = law.grow(start, tiny), b = law.grow(start, 2 * tiny);
            ASSERT_GE(a, start);
            ASSERT_GE(b, a * (1 - 1e-14));  // to rounding
        }
        double nm = 0;
        for (int i = 0; i < 3000; ++i) {
            const double next = law.grow(nm, 1);
            ASSERT_GT(next, nm);
            nm = next;
        }
    }
}

TEST(Growth, NothingHappensWithoutExposure) {
    const GrowthLaw law;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double nm : {0.0, 3.0, 12.0, 400.0}) {
        EXPECT_EQ(law.grow(nm, 0), nm);
        EXPECT_EQ(law.grow(nm, -1), nm);
        EXPECT_EQ(law.grow(nm, nan), nm);
    }
    EXPECT_TRUE(std::isnan(law.grow(nan, 1)));
}

TEST(Growth, RefusesRatesOutOfRange) {
    GrowthOptions options;
    options.parabolic_rate = -1;
    const Error error = error_of([&] { GrowthLaw law(options); });
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_EQ(error.sentence(), "parabolic_rate is -1; allowed are 1e-09 to 1000000");
}

}  // namespace
}  // namespace verdigris
