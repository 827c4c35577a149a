// SPDX-License-Identifier: MIT
#include "verdigris/copper/color_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "verdigris/copper/testing.h"
#include "verdigris/files/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

LinearF exact(const SurfaceState& state, const SurfaceOptics& optics = {}) {
    return linear_from_reflectance(surface_reflectance(state, optics));
}

double largest(LinearF a, LinearF b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

struct Worst {
    double linear = 0, delta_e = 0;
};
Worst worst_error(const SurfaceOptics& optics, const ColorTableOptions& options, int samples) {
    const ColorTable table(optics, options);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    Worst worst;
    for (int i = 0; i < samples; ++i) {
        // Half of the samples where the colors are, below 200 nm.
        const double nm = (i % 2 ? 200 : 1000) * unit(random);
        const SurfaceState state{nm, unit(random), i % 10 == 0 ? 10 * unit(random) : 0};
        const LinearF a = table.at(state), b = exact(state, optics);
        worst.linear = std::max(worst.linear, largest(a, b));
        worst.delta_e = std::max(worst.delta_e, delta_e2000(lab_of(a), lab_of(b)));
    }
    return worst;
}

TEST(ColorTable, ErrorStaysBelowWhatTheHeaderStates) {
    const Worst rough = worst_error({}, {}, 8000);
    measured("color table, default, largest linear error", rough.linear);
    measured("color table, default, largest CIEDE2000", rough.delta_e);
    EXPECT_LT(rough.linear, 0.001);
    EXPECT_LT(rough.delta_e, 0.1);
    const Worst ideal = worst_error(ideal_film(), {}, 8000);
    measured("color table, ideal film, largest linear error", ideal.linear);
    measured("color table, ideal film, largest CIEDE2000", ideal.delta_e);
    EXPECT_LT(ideal.linear, 0.001);
    EXPECT_LT(ideal.delta_e, 0.1);
}

TEST(ColorTable, FiveFractionsAreTooFew) {
    ColorTableOptions options;
    options.fractions = 5;
    const Worst worst = worst_error(ideal_film(), options, 8000);
    measured("color table, 5 fractions, largest CIEDE2000", worst.delta_e);
    EXPECT_GT(worst.delta_e, 2);
}

TEST(ColorTable, NodesAreExact) {
    for (const FilmStructure structure : {FilmStructure::mixed, FilmStructure::layered}) {
        for (const Polarization polarization :
             {Polarization::s, Polarization::p, Polarization::unpolarized}) {
            SurfaceOptics optics;
            optics.structure = structure;
            optics.incidence = {0.7, polarization};
            optics.roughness_factor = 1.3;
            ColorTableOptions options;
            options.fractions = 5;
            options.most_nm = 400;
            const ColorTable table(optics, options);
            EXPECT_EQ(table.thicknesses(), 1601);
            for (double nm : {0.0, 0.25, 15.75, 16.0, 33.5, 100.0, 399.75, 400.0}) {
                for (double f : {0.0, 0.5, 1.0}) {
                    EXPECT_LT(largest(table.at({nm, f, 0}), exact({nm, f, 0}, optics)), 2e-6);
                }
            }
        }
    }
}

TEST(ColorTable, ClampsAndSwallowsNan) {
    ColorTableOptions options;
    options.fractions = 3;
    const ColorTable table({}, options);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(table.at({-5, 0.5, 0}), table.at({0, 0.5, 0}));
    EXPECT_EQ(table.at({1e9, 0.5, 0}), table.at({1000, 0.5, 0}));
    EXPECT_EQ(table.at({1e300, 0.5, 0}), table.at({1000, 0.5, 0}));
    EXPECT_EQ(table.at({20, 7, 0}), table.at({20, 1, 0}));
    EXPECT_EQ(table.at({nan, nan, nan}), table.at({0, 0, 0}));
    EXPECT_EQ(table.at({20, 1, -1}), table.at({20, 1, 0}));
}

TEST(ColorTable, IsTheSameAtAnyThreadCount) {
    ColorTableOptions options;
    options.fractions = 9;
    options.most_nm = 200;
    set_thread_count(1);
    const ColorTable one({}, options);
    set_thread_count(0);
    const ColorTable many({}, options);
    for (double nm = 0; nm <= 200; nm += 0.1) {
        EXPECT_EQ(one.at({nm, 0.37, 0}), many.at({nm, 0.37, 0}));
    }
}

TEST(ColorTable, RefusesOptionsOutOfRange) {
    const auto said = [](const ColorTableOptions& options) {
        return error_of([&] { ColorTable table({}, options); }).sentence();
    };
    ColorTableOptions options;
    options.step_nm = 0;
    EXPECT_EQ(said(options), "step_nm is 0; allowed are 0.05 to 5");
    options = {};
    options.fractions = 1;
    EXPECT_EQ(said(options), "fractions is 1; allowed are 2 to 129");
    options = {};
    options.most_nm = 1e9;
    EXPECT_NE(said(options).find("most_nm"), std::string::npos);
}

}  // namespace
}  // namespace verdigris
