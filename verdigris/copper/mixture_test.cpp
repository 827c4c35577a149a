// SPDX-License-Identifier: MIT
#include "verdigris/copper/mixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "verdigris/copper/optical_constants.h"
#include "verdigris/copper/testing.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

using Complex = std::complex<double>;

TEST(Bruggeman, EndPointsAreThePureMaterials) {
    const Complex a{2.9, 0.3}, b{2.6, 0.5};
    EXPECT_EQ(bruggeman_index(a, b, 1), a);
    EXPECT_EQ(bruggeman_index(a, b, 0), b);
    EXPECT_LT(std::abs(bruggeman_index(a, b, 1 - 1e-12) - a), 1e-11);
    EXPECT_LT(std::abs(bruggeman_index(a, b, 1e-12) - b), 1e-11);
    EXPECT_LT(std::abs(bruggeman_index(a, a, 0.3) - a), 1e-14);
}

TEST(Bruggeman, SolvesItsEquationAndAbsorbs) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        const Complex a{-10 + 20 * unit(random), 5 * unit(random) + 1e-3};
        const Complex b{-10 + 20 * unit(random), 5 * unit(random) + 1e-3};
        const double f = unit(random);
        const Complex e = bruggeman_permittivity(a, b, f);
        const Complex left = f * (a - e) * (b + 2.0 * e) + (1 - f) * (b - e) * (a + 2.0 * e);
        worst = std::max(worst, std::abs(left) / (std::norm(a) + std::norm(b)));
        ASSERT_GE(e.imag(), 0);
        const Complex swapped = bruggeman_permittivity(b, a, 1 - f);
        ASSERT_LT(std::abs(swapped - e), 1e-10 * (std::abs(a) + std::abs(b)));
    }
    measured("Bruggeman, largest relative residual of its equation", worst);
    EXPECT_LT(worst, 1e-12);
}

TEST(Bruggeman, TransparentMixturesLieBetweenTheirParts) {
    double before = 1.5;
    for (double f = 0.05; f < 1; f += 0.05) {
        const Complex n = bruggeman_index(2.5, 1.5, f);
        EXPECT_EQ(n.imag(), 0);
        EXPECT_GT(n.real(), before);
        before = n.real();
    }
    EXPECT_LT(before, 2.5);
}

TEST(Bruggeman, OxidesMixSmoothlyOverTheWholeRange) {
    for (double nm = 380; nm <= 780; nm += 10) {
        const Complex a = cuprous_oxide_constants().at(nm), b = cupric_oxide_constants().at(nm);
        Complex before = b;
        for (int i = 1; i <= 100; ++i) {
            const Complex n = bruggeman_index(a, b, i / 100.0);
            EXPECT_LT(std::abs(n - before), 0.02);  // no jump between the roots
            before = n;
        }
    }
}

TEST(Bruggeman, RefusesAShareThatIsNone) {
    for (double f : {-0.01, 1.01, std::nan("")}) {
        EXPECT_EQ(error_of([&] { bruggeman_index(2, 3, f); }).code(), ErrorCode::usage);
    }
}

}  // namespace
}  // namespace verdigris
