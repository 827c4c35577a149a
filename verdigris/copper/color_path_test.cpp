// SPDX-License-Identifier: MIT
// The way of the colors as a film grows: against an independent computation, and by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>

#include "verdigris/copper/patina.h"
#include "verdigris/copper/testing.h"

namespace verdigris {
namespace {

Lab film_lab(double nm, double fraction, Observer observer = Observer::table) {
    return lab_of(
        linear_from_reflectance(surface_reflectance({nm, fraction, 0}, ideal_film()), observer));
}

double hue(Lab lab) {  // degrees: 0 red, 90 yellow, 180 green, 270 blue
    const double h = std::atan2(lab.b, lab.a) * 180 / std::numbers::pi;
    return h < 0 ? h + 360 : h;
}
double chroma(Lab lab) {
    return std::hypot(lab.a, lab.b);
}

TEST(ColorPath, MatchesTheReferenceTable) {
    for (const Observer observer : {Observer::fits, Observer::table}) {
        double worst = 0, sum = 0;
        int count = 0;
        for (const ReferenceColor& row : kReferencePath) {
            for (std::size_t i = 0; i < kReferenceFractions.size(); ++i) {
                const Lab lab = film_lab(row.nm, kReferenceFractions[i], observer);
                const double difference = delta_e2000(lab, row.lab[i]);
                EXPECT_LT(difference, 2) << row.nm << " nm, f = " << kReferenceFractions[i];
                worst = std::max(worst, difference);
                sum += difference;
                ++count;
            }
        }
        EXPECT_EQ(count, 140);
        const bool fits = observer == Observer::fits;
        measured(fits ? "color path, fits: largest CIEDE2000" : "color path, table: largest",
                 worst);
        measured(fits ? "color path, fits: mean CIEDE2000" : "color path, table: mean",
                 sum / count);
    }
}

TEST(ColorPath, GoesByItsNamesInOrder) {
    // At a Cu2O share of one half. Ranges of hue are wide: this is about names.
    const auto at = [](double nm) { return film_lab(nm, 0.5); };
    EXPECT_TRUE(hue(at(0)) > 40 && hue(at(0)) < 60) << "copper";
    EXPECT_TRUE(chroma(at(8)) > 1.5 * chroma(at(0)) && hue(at(8)) > 45) << "gold";
    EXPECT_TRUE(hue(at(18)) > 30 && at(18).l < 62) << "red-brown";
    EXPECT_TRUE(hue(at(28)) > 330 && at(28).l < 35) << "violet";
    EXPECT_TRUE(hue(at(38)) > 230 && hue(at(38)) < 300) << "blue";
    EXPECT_TRUE(chroma(at(46)) < 8 && at(46).l > 60) << "silver";
    EXPECT_TRUE(hue(at(80)) > 60 && hue(at(80)) < 95 && chroma(at(80)) > 20) << "second gold";
    EXPECT_TRUE(hue(at(140)) > 170 && hue(at(140)) < 230 && chroma(at(140)) > 20) << "green";
}

TEST(ColorPath, PureCuprousOxideHasNoFirstOrderBlue) {
    // Its absorption in the red is too weak: rose, then silver. So the default chemistry, which
    // is pure Cu2O up to 30 nm, meets its blue in the second order only.
    for (double nm = 20; nm <= 100; nm += 1) {
        for (const double fraction : {1.0, cu2o_fraction(nm)}) {
            const Lab lab = film_lab(nm, fraction);
            EXPECT_FALSE(hue(lab) > 220 && hue(lab) < 300 && chroma(lab) > 5) << nm;
        }
    }
    const Lab late = film_lab(134, cu2o_fraction(134));
    EXPECT_TRUE(hue(late) > 220 && hue(late) < 300 && chroma(late) > 15);
}

TEST(ColorPath, ChannelsTurnAtDifferentThicknesses) {
    // What a forecaster's color reversal is made of: minima of B, then G, then R.
    const auto minimum = [](double fraction, auto channel) {
        double best = 10, where = 0;
        for (double nm = 5; nm < 60; nm += 0.5) {
            const double v = channel(
                linear_from_reflectance(surface_reflectance({nm, fraction, 0}, ideal_film())));
            if (v < best) best = v, where = nm;
        }
        return where;
    };
    const auto r = [](LinearF c) { return c.r; };
    const auto g = [](LinearF c) { return c.g; };
    const auto b = [](LinearF c) { return c.b; };
    EXPECT_NEAR(minimum(0.5, b), 20, 2.5);
    EXPECT_NEAR(minimum(0.5, g), 24, 2.5);
    EXPECT_NEAR(minimum(0.5, r), 33, 2.5);
    EXPECT_NEAR(minimum(1.0, b), 16, 2.5);
    EXPECT_NEAR(minimum(1.0, g), 20, 2.5);
    EXPECT_NEAR(minimum(1.0, r), 31, 2.5);
}

TEST(ColorPath, SourcesOfCopperDifferByThisMuch) {
    const std::filesystem::path shared = std::filesystem::path(VERDIGRIS_SHARED_DATA) / "optical";
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no " << shared;
    const LinearF ours = linear_from_reflectance(surface_reflectance({}));
    for (const char* file : {"nk_Cu_Johnson.csv", "nk_Cu_SOPRA.csv"}) {
        SurfaceOptics optics;
        optics.materials.metal = read_optical_constants(shared / file);
        const LinearF other = linear_from_reflectance(surface_reflectance({}, optics));
        measured((std::string(file) + ", red against ours").c_str(), double(other.r / ours.r));
        measured((std::string(file) + ", green against ours").c_str(), double(other.g / ours.g));
        measured((std::string(file) + ", blue against ours").c_str(), double(other.b / ours.b));
        const double difference = delta_e2000(lab_of(ours), lab_of(other));
        measured((std::string(file) + ", CIEDE2000 against ours").c_str(), difference);
        EXPECT_LT(difference, 10);
    }
}

TEST(ColorPath, DefaultGrowthChangesTheColorAsMuchAsThePaperPrints) {
    const auto shown = [](double nm) {
        return encoded_from_linear(
            linear_from_reflectance(surface_reflectance({nm, cu2o_fraction(nm), 0})));
    };
    const double end = GrowthLaw().grow(4, 98.4);
    const SrgbF a = shown(4), b = shown(end);
    const double change = (std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b)) / 3;
    measured("film after a recording that starts at 4 nm, in nm", end);
    measured("mean change of its encoded color", change);
    EXPECT_TRUE(change > 0.12 && change < 0.13) << change;  // [Paper]: 0.128 and 0.119
}

TEST(ColorPath, BareCopperNeedsTheExposure) {
    const LinearF copper = linear_from_reflectance(surface_reflectance({}));
    EXPECT_NEAR(copper.r, 1.04, 0.01);
    const SrgbU8 shown = u8_from_srgb(encoded_from_linear(copper));
    EXPECT_NEAR(shown.r, 0xcf, 1);
    EXPECT_NEAR(shown.g, 0xac, 1);
    EXPECT_NEAR(shown.b, 0x9d, 1);
}

}  // namespace
}  // namespace verdigris
