// SPDX-License-Identifier: MIT
#include "verdigris/copper/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verdigris/copper/testing.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

double largest_difference(const Spectrum& a, const Spectrum& b) {
    double worst = 0;
    for (std::size_t i = 0; i < kBands; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

TEST(Surface, CleanCopperIsFresnelsCopper) {
    SurfaceOptics optics;  // spread and brown limit do nothing to a film that is not there
    for (const FilmStructure structure : {FilmStructure::mixed, FilmStructure::layered}) {
        optics.structure = structure;
        const Spectrum clean = surface_reflectance({}, optics);
        for (int band = 0; band < kBands; ++band) {
            const auto n = copper_constants().at(band_nm(band));
            EXPECT_NEAR(clean[std::size_t(band)], std::norm((1.0 - n) / (1.0 + n)), 1e-14);
        }
    }
}

TEST(Surface, IsAReflectanceEverywhere) {
    for (const double spread : {0.0, 0.1, 0.3}) {
        SurfaceOptics optics;
        optics.thickness_spread = spread;
        for (const double angle : {0.0, 1.2}) {
            optics.incidence.angle = angle;
            for (double film = 0; film < 1200; film += 61) {
                for (const double fraction : {0.0, 0.4, 1.0}) {
                    for (const double patina : {0.0, 3.0, 30.0}) {
                        for (double r : surface_reflectance({film, fraction, patina}, optics)) {
                            ASSERT_TRUE(r >= 0 && r <= 1) << r;
                        }
                    }
                }
            }
        }
    }
}

TEST(Surface, LayersOfOneOxideAreTheMixture) {
    SurfaceOptics layered;
    layered.structure = FilmStructure::layered;
    for (const double fraction : {0.0, 1.0}) {
        const SurfaceState state{70, fraction, 0};
        EXPECT_LT(
            largest_difference(surface_reflectance(state), surface_reflectance(state, layered)),
            1e-13);
    }
    EXPECT_GT(largest_difference(surface_reflectance({70, 0.5, 0}),
                                 surface_reflectance({70, 0.5, 0}, layered)),
              0.005);
}

TEST(Surface, NodesIntegrateTheNormalDistribution) {
    const double s = 0.2;
    double moments[11]{};
    for (const ThicknessNode& node : thickness_nodes(s)) {
        for (int power = 0; power <= 10; ++power) {
            moments[power] += node.weight * std::pow((node.factor - 1) / s, power);
        }
    }
    const double known[] = {1, 0, 1, 0, 3, 0, 15, 0, 105, 0};  // (2k - 1)!!
    for (int power = 0; power < 10; ++power) {
        EXPECT_NEAR(moments[power], known[power], 1e-11) << power;
    }
    EXPECT_GT(std::abs(moments[10] - 945), 1);  // and that is where five points end
}

TEST(Surface, SpreadWashesOutHighOrdersAndSparesThinFilms) {
    SurfaceOptics rough = ideal_film();
    rough.thickness_spread = 0.1;
    const auto chroma = [](const SurfaceState& state, const SurfaceOptics& optics) {
        const Lab lab = lab_of(linear_from_reflectance(surface_reflectance(state, optics)));
        return std::hypot(lab.a, lab.b);
    };
    EXPECT_LT(chroma({110, 1, 0}, rough), 0.8 * chroma({110, 1, 0}, ideal_film()));
    EXPECT_NEAR(chroma({8, 1, 0}, rough) / chroma({8, 1, 0}, ideal_film()), 1, 0.02);
}

TEST(Surface, RoughnessFactorSpreadsTheSameMassThinner) {
    SurfaceOptics rough;
    rough.roughness_factor = 1.5;
    EXPECT_LT(largest_difference(surface_reflectance({60, 0.5, 0}, rough),
                                 surface_reflectance({40, 0.5, 0})),
              1e-14);
}

TEST(Surface, ThickFilmsTurnBrownBlack) {
    EXPECT_EQ(brown_share(0), 0);
    EXPECT_NEAR(brown_share(300), 1 - std::exp(-1.0), 1e-15);
    EXPECT_GT(brown_share(800), 0.999);  // attained at 0.8 um [Leygraf2019]
    const Lab brown = lab_of(linear_from_reflectance(surface_reflectance({1000, 0.4, 0})));
    EXPECT_LT(delta_e2000(brown, {25, 10, 8}), 1);
    EXPECT_LT(delta_e2000(brown, lab_of(linear_from_reflectance(brown_spectrum()))), 0.01);
}

TEST(Surface, PatinaCoversInGreen) {
    EXPECT_EQ(patina_transmission(0), 1);
    EXPECT_LT(patina_transmission(12), 0.003);  // covers at 12 um [Leygraf2019]
    const Lab green = lab_of(linear_from_reflectance(surface_reflectance({800, 0.4, 12})));
    EXPECT_LT(delta_e2000(green, {66, -24, 1}), 1);
    // Two layers in turn are one layer: what is let through multiplies.
    EXPECT_NEAR(patina_transmission(3) * patina_transmission(5), patina_transmission(8), 1e-15);
}

TEST(Surface, ATableOfOnesOwnIsUsedAndMustCoverTheVisible) {
    SurfaceOptics optics;
    optics.materials.metal = OpticalConstants("glass", {{300, 1.5, 0}, {900, 1.5, 0}});
    EXPECT_NEAR(surface_reflectance({}, optics)[20], 0.04, 1e-15);
    optics.materials.metal = OpticalConstants("narrow", {{400, 1.5, 0}, {900, 1.5, 0}});
    const Error error = error_of([&] { surface_reflectance({}, optics); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(error.where(), "narrow");
}

TEST(Surface, RefusesStatesAndOptionsOutOfRange) {
    const auto said = [](const SurfaceState& state, const SurfaceOptics& optics = {}) {
        const Error error = error_of([&] { surface_reflectance(state, optics); });
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.sentence();
    };
    EXPECT_EQ(said({-1, 1, 0}), "film_nm is -1; allowed are 0 to 100000");
    EXPECT_EQ(said({1, 1.5, 0}), "cu2o_fraction is 1.5; allowed are 0 to 1");
    EXPECT_EQ(said({1, 1, -2}), "patina_um is -2; allowed are 0 to 10000");
    SurfaceOptics optics;
    optics.thickness_spread = 0.4;
    EXPECT_EQ(said({}, optics), "thickness_spread is 0.4; allowed are 0 to 0.3");
    optics = {};
    optics.roughness_factor = 0.5;
    EXPECT_EQ(said({}, optics), "roughness_factor is 0.5; allowed are 1 to 5");
}

}  // namespace
}  // namespace verdigris
