// SPDX-License-Identifier: MIT
#include "verdigris/copper/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verdigris/copper/surface.h"
#include "verdigris/copper/testing.h"

namespace verdigris {
namespace {

Spectrum flat(double reflectance) {
    Spectrum spectrum;
    spectrum.fill(reflectance);
    return spectrum;
}

constexpr Observer kObservers[] = {Observer::table, Observer::fits};

TEST(Spectrum, WhiteIsWhiteAndGrayIsGray) {
    for (const Observer observer : kObservers) {
        const LinearF white = linear_from_reflectance(flat(1), observer);
        EXPECT_NEAR(white.r, 1, 1e-6);
        EXPECT_NEAR(white.g, 1, 1e-6);
        EXPECT_NEAR(white.b, 1, 1e-6);
        const Lab lab = lab_from_xyz(xyz_from_reflectance(flat(1), observer));
        EXPECT_NEAR(lab.l, 100, 1e-4);
        EXPECT_NEAR(lab.a, 0, 1e-3);
        EXPECT_NEAR(lab.b, 0, 1e-3);
        const LinearF gray = linear_from_reflectance(flat(0.18), observer);
        EXPECT_NEAR(gray.r, 0.18, 1e-6);
        EXPECT_NEAR(gray.b, 0.18, 1e-6);
    }
}

TEST(Spectrum, UnscaledWhiteIsD65) {
    // Before white is normalized, both observers see D65 (0.95047, 1, 1.08883) [CIE15].
    for (const Observer observer : kObservers) {
        std::array<double, 3> white{};
        for (int band = 0; band < kBands; ++band) {
            const auto cmf = color_matching(band, observer);
            for (std::size_t c = 0; c < 3; ++c) white[c] += d65_power(band) * cmf[c];
        }
        EXPECT_NEAR(white[0] / white[1], 0.95047, 4e-4);
        EXPECT_NEAR(white[2] / white[1], 1.08883, 1e-3);
    }
    EXPECT_EQ(d65_power(18), 100);  // at 560 nm
}

TEST(Spectrum, FitsFollowTheTable) {
    double worst = 0;
    for (int band = 0; band < kBands; ++band) {
        const auto table = color_matching(band, Observer::table);
        const auto fits = color_matching(band, Observer::fits);
        for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(table[c] - fits[c]));
    }
    EXPECT_NEAR(color_matching(18, Observer::table)[1], 0.995, 1e-4);  // y at 560 nm [CIE15]
    measured("color-matching fits against the table, largest difference (peak 1.78)", worst);
    EXPECT_LT(worst, 0.06);
}

TEST(Spectrum, ObserversAgreeOnCopperAndItsFilms) {
    double worst = 0;
    for (const double fraction : {0.0, 0.5, 1.0}) {
        for (double nm = 0; nm <= 400; nm += 2) {
            const Spectrum s = surface_reflectance({nm, fraction, 0}, ideal_film());
            worst =
                std::max(worst, delta_e2000(lab_from_xyz(xyz_from_reflectance(s)),
                                            lab_from_xyz(xyz_from_reflectance(s, Observer::fits))));
        }
    }
    measured("observer fits against table, films to 400 nm, largest CIEDE2000", worst);
    EXPECT_LT(worst, 1.5);
}

TEST(Spectrum, LinearWeightsAreTheColor) {
    const Spectrum copper = surface_reflectance({});
    const LinearF direct = linear_from_xyz(xyz_from_reflectance(copper));
    const LinearF dotted = linear_from_reflectance(copper);
    EXPECT_NEAR(direct.r, dotted.r, 1e-5);
    EXPECT_NEAR(direct.g, dotted.g, 1e-5);
    EXPECT_NEAR(direct.b, dotted.b, 1e-5);
}

TEST(Spectrum, ExposureClipsAtWhiteOnly) {
    const SrgbF clipped = encoded_from_linear({2, 1 / 0.6f, -0.1f});
    EXPECT_NEAR(clipped.r, 1, 1e-6);
    EXPECT_NEAR(clipped.g, 1, 1e-6);
    EXPECT_EQ(clipped.b, 0);
    EXPECT_NEAR(encoded_from_linear({1, 0, 0}, 0.5).r, srgb_from_linear(0.5f), 1e-6);
}

}  // namespace
}  // namespace verdigris
