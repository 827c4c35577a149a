// SPDX-License-Identifier: MIT
#include "verdigris/copper/thin_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "verdigris/copper/optical_constants.h"
#include "verdigris/copper/spectrum.h"
#include "verdigris/copper/testing.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

using Complex = std::complex<double>;

double fresnel(Complex above, Complex below) {
    return std::norm((above - below) / (above + below));
}

struct RandomStack {
    double nm;
    std::vector<FilmLayer> layers;
    Complex substrate;
    Incidence incidence;
};

RandomStack random_stack(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    RandomStack stack;
    stack.nm = 380 + 400 * unit(random);
    const int count = int(6 * unit(random));  // up to five films
    for (int i = 0; i < count; ++i) {
        const bool clear = unit(random) < 0.3;
        const double thick = unit(random) < 0.1 ? 1e5 : 1000;
        stack.layers.push_back({{0.05 + 4 * unit(random), clear ? 0 : 5 * unit(random)},
                                thick * unit(random) * unit(random)});
    }
    stack.substrate = {0.05 + 3 * unit(random), 5 * unit(random)};
    const double angles[] = {0, 0.3, 1.2, 89.9 * std::numbers::pi / 180};
    stack.incidence.angle =
        unit(random) < 0.3 ? angles[int(4 * unit(random))] : 1.55 * unit(random);
    stack.incidence.polarization = Polarization(int(3 * unit(random)));
    return stack;
}

TEST(ThinFilm, WithoutThicknessItIsBareCopper) {
    for (int band = 0; band < kBands; ++band) {
        const double nm = band_nm(band);
        const Complex copper = copper_constants().at(nm);
        const FilmLayer none{cuprous_oxide_constants().at(nm), 0};
        EXPECT_NEAR(airy_reflectance(nm, {&none, 1}, copper), fresnel(1, copper), 1e-15);
        EXPECT_NEAR(airy_reflectance(nm, {}, copper), fresnel(1, copper), 1e-15);
        EXPECT_NEAR(transfer_matrix_reflectance(nm, {}, copper), fresnel(1, copper), 1e-15);
    }
}

TEST(ThinFilm, WithoutEndItIsTheBulkOxide) {
    for (int band = 0; band < kBands; ++band) {
        const double nm = band_nm(band);
        const Complex copper = copper_constants().at(nm), oxide = cupric_oxide_constants().at(nm);
        for (double thickness : {1e5, 1e7, 1e12}) {
            const FilmLayer film{oxide, thickness};
            EXPECT_NEAR(airy_reflectance(nm, {&film, 1}, copper), fresnel(1, oxide), 1e-12);
            EXPECT_NEAR(transfer_matrix_reflectance(nm, {&film, 1}, copper), fresnel(1, oxide),
                        1e-12);
        }
    }
}

TEST(ThinFilm, QuarterWaveLayerHidesGlass) {
    // The textbook case: n = sqrt(n_glass), a quarter wave thick, reflects nothing [BornWolf1999].
    const FilmLayer coat{1.5, 550 / (4 * 1.5)};
    EXPECT_NEAR(airy_reflectance(550, {&coat, 1}, 2.25), 0, 1e-15);
    EXPECT_NEAR(transfer_matrix_reflectance(550, {&coat, 1}, 2.25), 0, 1e-15);
    const FilmLayer half{1.9, 550 / (2 * 1.9)};  // half a wave is not there at all
    EXPECT_NEAR(airy_reflectance(550, {&half, 1}, 2.25), fresnel(1, 2.25), 1e-15);
}

TEST(ThinFilm, BrewstersAngleReflectsNoP) {
    const Incidence brewster{std::atan(1.5), Polarization::p};
    EXPECT_NEAR(airy_reflectance(550, {}, 1.5, brewster), 0, 1e-15);
    const double s = airy_reflectance(550, {}, 1.5, {brewster.angle, Polarization::s});
    EXPECT_NEAR(s, std::pow((2.25 - 1) / (2.25 + 1), 2), 1e-15);  // cos^2 gives ((n2-1)/(n2+1))^2
    EXPECT_NEAR(airy_reflectance(550, {}, 1.5, {brewster.angle}), s / 2, 1e-15);
}

TEST(ThinFilm, RecursionAndMatricesAgreeOnRandomStacks) {
    std::mt19937_64 random(11);
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const RandomStack stack = random_stack(random);
        const double airy =
            airy_reflectance(stack.nm, stack.layers, stack.substrate, stack.incidence);
        const double matrix =
            transfer_matrix_reflectance(stack.nm, stack.layers, stack.substrate, stack.incidence);
        worst = std::max(worst, std::abs(airy - matrix));
        ASSERT_TRUE(airy >= 0 && airy <= 1 + 1e-14) << airy;
    }
    measured("Airy against transfer matrix, largest difference, 200000 stacks", worst);
    EXPECT_LT(worst, 1e-12);
}

TEST(ThinFilm, CopperNeverReflectsMoreThanArrives) {
    for (int band = 0; band < kBands; ++band) {
        const double nm = band_nm(band);
        for (double thickness = 0; thickness < 1000; thickness += 3.7) {
            const FilmLayer films[] = {{cupric_oxide_constants().at(nm), thickness / 3},
                                       {cuprous_oxide_constants().at(nm), thickness}};
            for (double angle : {0.0, 0.5, 1.0, 1.5, 1.57}) {
                const double r = airy_reflectance(nm, films, copper_constants().at(nm), {angle});
                ASSERT_TRUE(r >= 0 && r <= 1) << r;
            }
        }
    }
}

TEST(ThinFilm, PolarizationsAreOneAtNormalIncidenceAndPartGradually) {
    std::mt19937_64 random(12);
    for (int i = 0; i < 1000; ++i) {
        RandomStack stack = random_stack(random);
        const auto reflectance = [&](double angle, Polarization polarization) {
            return airy_reflectance(stack.nm, stack.layers, stack.substrate, {angle, polarization});
        };
        const double s = reflectance(0, Polarization::s);
        EXPECT_NEAR(reflectance(0, Polarization::p), s, 1e-13);
        EXPECT_EQ(reflectance(0, Polarization::unpolarized), s);
        EXPECT_NEAR(reflectance(1e-9, Polarization::p), s, 1e-6);  // no jump where the angle is 0
    }
}

TEST(ThinFilm, SplittingAFilmChangesNothing) {
    std::mt19937_64 random(13);
    for (int i = 0; i < 1000; ++i) {
        const RandomStack stack = random_stack(random);
        std::vector<FilmLayer> split;
        for (const FilmLayer& layer : stack.layers) {
            split.push_back({layer.index, 0.3 * layer.thickness_nm});
            split.push_back({layer.index, 0.7 * layer.thickness_nm});
        }
        EXPECT_NEAR(airy_reflectance(stack.nm, stack.layers, stack.substrate, stack.incidence),
                    airy_reflectance(stack.nm, split, stack.substrate, stack.incidence), 1e-11);
    }
}

TEST(ThinFilm, ANegativeZeroOfAbsorptionIsNoGain) {
    // Beyond the critical angle the wave must die away below; -0.0 would pick the other root.
    const FilmLayer plus{{0.5, 0.0}, 80}, minus{{0.5, -0.0}, 80};
    for (auto method : {airy_reflectance, transfer_matrix_reflectance}) {
        const double r = method(550, {&plus, 1}, {0.2, 3}, {1.3, Polarization::unpolarized});
        EXPECT_EQ(method(550, {&minus, 1}, {0.2, 3}, {1.3, Polarization::unpolarized}), r);
    }
    EXPECT_GE(normal_wave_number({0.5, -0.0}, 1.3).imag(), 0.5);
}

TEST(ThinFilm, RefusesWhatIsNoFilm) {
    const auto refused = [](double nm, FilmLayer film, Complex metal, double angle) {
        for (auto method : {airy_reflectance, transfer_matrix_reflectance}) {
            EXPECT_EQ(error_of([&] {
                          method(nm, {&film, 1}, metal, {angle});
                      }).code(),
                      ErrorCode::usage);
        }
    };
    const Complex metal{0.2, 3};
    refused(0, {2, 10}, metal, 0);
    refused(500, {2, -1}, metal, 0);
    refused(500, {Complex(2, -1), 10}, metal, 0);
    refused(500, {0, 10}, metal, 0);
    refused(500, {2, 10}, {0, 3}, 0);
    refused(500, {2, 10}, metal, std::numbers::pi / 2);
    refused(500, {2, std::numeric_limits<double>::quiet_NaN()}, metal, 0);
}

}  // namespace
}  // namespace verdigris
