// SPDX-License-Identifier: MIT
// Eqs. (2) and (3) of the paper at pixels worked out by hand, and the conventions of the normal.
#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/material/material.h"
#include "verdigris/material/testing.h"

namespace verdigris {
namespace {

/// A recipe that needs no context: canvas gray, tau 0.02, s 0.2, everything active.
MaterialRecipe plain_recipe(int width, int height) {
    MaterialRecipe recipe;
    recipe.canvas = flat(width, height, {0.5f, 0.5f, 0.5f});
    recipe.dead_zone = Image<float>(width, height);
    for (float& d : recipe.dead_zone.pixels()) d = 0.02f;
    recipe.tau = 0.02;
    recipe.normalizer = 0.2;
    return recipe;
}

TEST(Equations, MatchHandComputedPixels) {
    // change = (0.06 + 0.18 + 0.12) / 3 = 0.12; excess = (0.12 - 0.02) / 0.2 = 0.5
    // p = 0.5^0.85 = 0.554785; r = 0.16 + 0.72 * 0.554785^0.75 = 0.622835
    // m = 0.03 + 0.94 * 0.445215^1.25 = 0.371855
    const MaterialRecipe recipe = plain_recipe(40, 40);
    Material m;
    materialize(recipe, flat(40, 40, {0.44f, 0.68f, 0.38f}).view(), m);
    const double p = std::pow(0.5, 0.85);
    EXPECT_NEAR(p, 0.554785, 1e-6);
    EXPECT_NEAR(m.coverage(20, 20), 0.554785, 2e-6);
    EXPECT_NEAR(m.roughness(20, 20), 0.16 + 0.72 * std::pow(p, 0.75), 2e-6);
    EXPECT_NEAR(m.metallic(20, 20), 0.03 + 0.94 * std::pow(1 - p, 1.25), 2e-6);
    EXPECT_NEAR(m.roughness(20, 20), 0.622835, 1e-5);
    EXPECT_NEAR(m.metallic(20, 20), 0.371855, 1e-5);
    // luma = 0.2126 * 0.44 + 0.7152 * 0.68 + 0.0722 * 0.38 = 0.607316
    EXPECT_NEAR(m.height(20, 20), 0.55 * 0.607316 + 0.45 * 0.554785, 5e-6);
    EXPECT_EQ(m.albedo(20, 20), (SrgbF{0.44f, 0.68f, 0.38f}));
}

TEST(Equations, HaveTheirEndPoints) {
    const MaterialRecipe recipe = plain_recipe(32, 32);
    Material m;
    materialize(recipe, flat(32, 32, {0.5f, 0.5f, 0.5f}).view(), m);  // the canvas itself
    EXPECT_EQ(m.coverage(9, 9), 0);
    EXPECT_NEAR(m.roughness(9, 9), 0.16, 1e-6);
    EXPECT_NEAR(m.metallic(9, 9), 0.97, 1e-6);
    materialize(recipe, flat(32, 32, {0.1f, 0.1f, 0.1f}).view(), m);  // far beyond tau + s
    EXPECT_EQ(m.coverage(9, 9), 1);
    EXPECT_NEAR(m.roughness(9, 9), 0.88, 1e-6);
    EXPECT_NEAR(m.metallic(9, 9), 0.03, 1e-6);
    materialize(recipe, flat(32, 32, {0.515f, 0.515f, 0.515f}).view(), m);  // inside the dead-zone
    EXPECT_EQ(m.coverage(9, 9), 0);
}

TEST(Equations, MicroRoughnessStaysWithinItsBand) {
    MaterialRecipe recipe = plain_recipe(64, 64);
    recipe.options.height_sigma = 0;
    Image<SrgbF> speckled = flat(64, 64, {0.5f, 0.5f, 0.5f});
    speckled(30, 30) = {0.51f, 0.51f, 0.51f};  // below the dead-zone: no coverage, only relief
    speckled(10, 10) = {0.49f, 0.49f, 0.49f};
    recipe.options.micro_range = 1e-4;
    Material m;
    materialize(recipe, speckled.view(), m);
    EXPECT_NEAR(m.roughness(30, 30), 0.16 + 0.06, 1e-6);
    EXPECT_NEAR(m.roughness(10, 10), 0.16 - 0.06, 1e-6);
    EXPECT_NEAR(m.roughness(50, 50), 0.16, 1e-4);  // rounding, magnified by the tiny range
}

/// Height follows the luma alone: no blur, no coverage.
Material of_luma(const Image<SrgbF>& frame, double gain = 8) {
    MaterialRecipe recipe = plain_recipe(frame.width(), frame.height());
    recipe.options.height_sigma = 0;
    recipe.options.height_patina_weight = 0;
    recipe.options.normal_gain = gain;
    recipe.canvas = frame.clone();
    Material m;
    materialize(recipe, frame.view(), m);
    return m;
}

SrgbF gray(double v) {
    return {float(v), float(v), float(v)};
}

TEST(Normal, PointsAwayFromTheRise) {
    const Material right = of_luma(paint(40, 30, [](int x, int) { return gray(0.2 + 0.01 * x); }));
    EXPECT_LT(right.normal(20, 15).x, -0.1f);  // rising to +x leans to -x
    EXPECT_NEAR(right.normal(20, 15).y, 0, 1e-5);
    // Rising downwards in the image (row 0 is the top) leans up: +Y is up.
    const Material down = of_luma(paint(40, 30, [](int, int y) { return gray(0.2 + 0.01 * y); }));
    EXPECT_GT(down.normal(20, 15).y, 0.1f);
    EXPECT_NEAR(down.normal(20, 15).x, 0, 1e-5);
}

TEST(Normal, HasTheSlopeThePaperAsksFor) {
    // Sobel of a ramp of 0.01 per pixel is 0.08; times 2.6 that is a slope of 0.208.
    const Material m = of_luma(paint(40, 30, [](int x, int) { return gray(0.2 + 0.01 * x); }));
    const Vec3F n = m.normal(20, 15);
    EXPECT_NEAR(n.x / n.z, -0.208, 1e-4);
    const Material gentle =
        of_luma(paint(40, 30, [](int x, int) { return gray(0.2 + 0.01 * x); }), 1);
    EXPECT_NEAR(gentle.normal(20, 15).x / gentle.normal(20, 15).z, -0.026, 1e-5);
}

TEST(Normal, OfABumpCatchesLightOnTheSideOfTheLamp) {
    const Material m = of_luma(paint(61, 61, [](int x, int y) {
        const double d2 = (x - 30) * (x - 30) + (y - 30) * (y - 30);
        return gray(0.3 + 0.3 * std::exp(-d2 / 100));
    }));
    EXPECT_NEAR(m.normal(30, 30).z, 1, 1e-5);
    EXPECT_GT(m.normal(40, 30).x, 0.1f);  // right flank leans right
    EXPECT_LT(m.normal(20, 30).x, -0.1f);
    EXPECT_GT(m.normal(30, 20).y, 0.1f);  // upper flank leans up
    EXPECT_LT(m.normal(30, 40).y, -0.1f);
}

TEST(Normal, IsUnitAndFlatWhereHeightIsFlat) {
    const Material m = of_luma(paint(50, 40, [](int x, int y) {
        return gray(x < 25 ? 0.4 : 0.4 + 0.3 * std::sin(x * 0.9) * std::cos(y * 0.7));
    }));
    for (const Vec3F& n : m.normal.pixels()) {
        EXPECT_NEAR(
            double(n.x) * double(n.x) + double(n.y) * double(n.y) + double(n.z) * double(n.z), 1,
            1e-6);
        EXPECT_GT(n.z, 0);
    }
    EXPECT_EQ(m.normal(10, 20), (Vec3F{0, 0, 1}));
}

TEST(Origins, AreHonestAboutWhatOneCameraKnows) {
    Context context;
    for (int t = 0; t < 5; ++t) context.frames.push_back(flat(4, 4, {0.5f, 0.4f, 0.3f}));
    Forecast moving = straight_forecast(context, {0.01f, 0, 0});
    moving.forecaster = "affinergb full order 1";
    const auto origins = map_origins(moving);
    ASSERT_EQ(origins.size(), 5u);
    EXPECT_EQ(origins[0].map, "albedo");
    EXPECT_EQ(origins[0].origin, Origin::modeled);
    EXPECT_NE(origins[0].sentence.find("affinergb full order 1"), std::string::npos);
    EXPECT_NE(origins[0].sentence.find("light"), std::string::npos);
    EXPECT_EQ(map_origins(persistence().forecast(context))[0].origin, Origin::measured);
    for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(origins[i].origin, Origin::modeled);
    EXPECT_EQ(to_string(Origin::assumed), "assumed");
    // The observed state is no forecast: its albedo is a photograph, and counted as clean it has no
    // patina that roughness and metallic could follow.
    for (const bool clean : {true, false}) {
        const auto seen = map_origins(moving, clean, MapsOf::observed);
        ASSERT_EQ(seen.size(), 5u);
        EXPECT_EQ(seen[0].origin, Origin::measured);
        EXPECT_NE(seen[0].sentence.find("light"), std::string::npos);
        EXPECT_EQ(seen[0].sentence.find("held"), std::string::npos);
        EXPECT_EQ(seen[3].origin, clean ? Origin::assumed : Origin::modeled);
        for (const MapOrigin& origin : seen) {
            EXPECT_EQ(origin.sentence.find("forecast"), std::string::npos) << origin.sentence;
        }
    }
}

}  // namespace
}  // namespace verdigris
