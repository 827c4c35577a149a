// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verdigris/error.h"
#include "verdigris/material/material.h"
#include "verdigris/material/testing.h"

namespace verdigris {
namespace {

Context of_values(const std::vector<float>& values) {
    Context context;
    for (float v : values) context.frames.push_back(flat(40, 3, {v, v / 2, 1 - v}));
    return context;
}

TEST(Canvas, IsTheTemporalMedian) {
    const auto canvas = [](const std::vector<float>& values) {
        const Context context = of_values(values);
        return prepare_material(context, persistence().forecast(context)).canvas(39, 2);
    };
    EXPECT_EQ(canvas({0.1f}).r, 0.1f);
    EXPECT_FLOAT_EQ(canvas({0.1f, 0.3f}).r, 0.2f);
    EXPECT_EQ(canvas({0.9f, 0.1f, 0.3f}).r, 0.3f);
    EXPECT_FLOAT_EQ(canvas({0.4f, 0.9f, 0.1f, 0.2f}).r, 0.3f);  // the mean of the middle two
    EXPECT_FLOAT_EQ(canvas({0.5f, 0.4f, 0.3f, 0.2f, 0.1f, 0.6f, 0.7f, 0.8f, 0.9f, 1.0f}).g, 0.275f);
}

TEST(Canvas, MatchesASortedColumn) {
    const Context context = copper_context(70, 20, 9);
    const MaterialRecipe recipe = prepare_material(context, persistence().forecast(context));
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 70; ++x) {
            std::vector<float> b;
            for (const auto& f : context.frames) b.push_back(f(x, y).b);
            std::sort(b.begin(), b.end());
            ASSERT_EQ(recipe.canvas(x, y).b, b[4]);
        }
    }
}

TEST(Coverage, IsExactlyZeroAtHorizonZero) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Context context = copper_context(83, 61, 5 + int(seed), seed);
        const Forecast forecast = straight_forecast(context, {-0.01f, 0.006f, 0.008f});
        const MaterialRecipe recipe = prepare_material(context, forecast);
        Material m;
        materialize(recipe, forecast, 0, m);
        for (float p : m.coverage.pixels()) ASSERT_EQ(p, 0.0f);
        materialize(recipe, forecast.at(0).view(), m);
        for (float p : m.coverage.pixels()) ASSERT_EQ(p, 0.0f);
        materialize(recipe, forecast, 20, m);
        EXPECT_GT(*std::max_element(m.coverage.pixels().begin(), m.coverage.pixels().end()), 0.7f);
    }
}

TEST(Coverage, IsContinuousAndGrowsWithAMonotoneDrift) {
    Context context = copper_context(64, 48, 8);
    for (auto& f : context.frames) f = context.frames[0].clone();
    const Forecast forecast = straight_forecast(context, {-0.01f, -0.006f, -0.004f});
    const MaterialRecipe recipe = prepare_material(context, forecast);
    Material before, now;
    materialize(recipe, forecast, 0, before);
    // The change grows by at most mean |rate| = 0.00667 per unit; p = e^0.85 is steepest at 0.
    const double step = 0.05;
    for (double h = step; h < 30; h += step) {
        materialize(recipe, forecast, h, now);
        for (std::size_t i = 0; i < now.coverage.pixel_count(); ++i) {
            const float a = before.coverage.pixels()[i], b = now.coverage.pixels()[i];
            ASSERT_GE(b, a - 1e-6f) << h;
            ASSERT_LE(double(b - a), std::pow(0.00667 * step / recipe.normalizer, 0.85) + 1e-5)
                << h;
        }
        std::swap(before, now);
    }
    EXPECT_GT(*std::max_element(before.coverage.pixels().begin(), before.coverage.pixels().end()),
              0.99f);
}

TEST(Coverage, LeavesBackdropAndGlintAlone) {
    const Context context = copper_context(60, 40, 6);
    Forecast forecast = straight_forecast(context, {-0.01f, 0.006f, 0.008f});
    // Even if the forecast moves there: only the active pixels may be covered.
    for (SrgbF& r : forecast.trajectory.rate.pixels()) r = {-0.01f, 0.006f, 0.008f};
    const MaterialRecipe recipe = prepare_material(context, forecast);
    Material m;
    materialize(recipe, forecast, 30, m);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 60; ++x) {
            const bool active = context.specimen(x, y) && !context.clipped(x, y);
            const bool specimen = context.specimen(x, y);
            EXPECT_EQ(recipe.active(x, y), active ? kInside : specimen ? kUnderGlint : 0);
            if (active) continue;
            EXPECT_EQ(m.coverage(x, y), 0);
            // The metal under a glint stays metal; the backdrop never was.
            EXPECT_NEAR(m.metallic(x, y), specimen ? 0.97 : 0.03, 1e-6);
            EXPECT_GE(m.roughness(x, y), specimen ? 0.04 : 0.88 - 0.06 - 1e-5);
        }
    }
}

// A vivid salt saturates one channel: it is covered like the salts around it, not polished metal.
TEST(Coverage, CountedFromTheStartGoesOnUnderWhatIsClipped) {
    Context context = copper_context(60, 40, 6);
    const Forecast forecast = straight_forecast(context, {0, 0, 0});
    const Image<SrgbF> now = forecast.at(0);
    Image<SrgbF> start = now.clone();
    for (SrgbF& c : start.pixels()) c = {c.r + 0.25f, c.g + 0.1f, c.b - 0.05f};
    const MaterialRecipe recipe = prepare_material(context, forecast, {}, &start);
    Material m;
    materialize(recipe, forecast, 10, m);
    int clipped = 0;
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 60; ++x) {
            if (!context.specimen(x, y)) {
                EXPECT_EQ(m.coverage(x, y), 0);
                continue;
            }
            clipped += context.clipped(x, y) != 0;
            EXPECT_EQ(recipe.active(x, y), kInside);
            // The specimen around is covered by 0.7 and more; the paper's 0 would be a hole.
            EXPECT_GT(m.coverage(x, y), 0.6) << x << ", " << y;
        }
    }
    EXPECT_GT(clipped, 5);
}

TEST(Glint, RaisesNoBump) {
    Context context = copper_context(60, 60, 6);
    for (auto& f : context.frames) {  // no texture: all relief there is comes from the glint
        for (std::size_t i = 0; i < f.pixel_count(); ++i) {
            if (!context.clipped.pixels()[i]) f.pixels()[i] = {0.6f, 0.42f, 0.33f};
        }
    }
    const Forecast forecast = straight_forecast(context, {-0.002f, 0.001f, 0.001f});
    MaterialOptions options;
    options.normal_gain = 8;  // the plain Sobel: any ridge shows at its steepest
    const MaterialRecipe filled = prepare_material(context, forecast, options);
    MaterialRecipe bare = prepare_material(context, forecast, options);
    for (float& v : bare.luma_fill.pixels()) v = -1;
    Material with, without;
    materialize(filled, forecast, 5, with);
    materialize(bare, forecast, 5, without);
    double steepest_with = 1, steepest_without = 1;
    for (int y = 20; y < 40; ++y) {
        for (int x = 18; x < 26; ++x) {  // the glint lies at 20..23
            steepest_with = std::min(steepest_with, double(with.normal(x, y).z));
            steepest_without = std::min(steepest_without, double(without.normal(x, y).z));
        }
    }
    EXPECT_LT(steepest_without, 0.7);
    EXPECT_GT(steepest_with, 0.999);
}

TEST(Normalizer, IsTheRobustEndOfTheChange) {
    // 200 pixels drift by 0.01 per unit and one by 0.5: the percentile ignores the one.
    Context context;
    for (int t = 0; t < 10; ++t) context.frames.push_back(flat(201, 1, {0.2f, 0.2f, 0.2f}));
    context.tau = 0.002;
    Forecast forecast = straight_forecast(context, {0.01f, 0.01f, 0.01f});
    forecast.trajectory.rate(7, 0) = {0.5f, 0.5f, 0.5f};
    forecast.trajectory.clamp = false;
    const MaterialRecipe recipe = prepare_material(context, forecast);
    EXPECT_EQ(recipe.reference_horizon, 20);
    EXPECT_NEAR(recipe.normalizer, 20 * 0.01 - 0.002, 1e-6);
    MaterialOptions options;
    options.reference_horizon = 5;
    EXPECT_NEAR(prepare_material(context, forecast, options).normalizer, 5 * 0.01 - 0.002, 1e-6);
}

TEST(Normalizer, IsOneWhereNothingChangesAndNeverBelowTau) {
    Context context;
    for (int t = 0; t < 10; ++t) context.frames.push_back(flat(20, 20, {0.2f, 0.2f, 0.2f}));
    context.tau = 0.002;
    EXPECT_EQ(prepare_material(context, persistence().forecast(context)).normalizer, 1);
    // 20 units of 1.05e-4 leave the dead-zone by 5 %: no full patina out of that.
    const Forecast faint = straight_forecast(context, {1.05e-4f, 1.05e-4f, 1.05e-4f});
    const MaterialRecipe recipe = prepare_material(context, faint);
    EXPECT_DOUBLE_EQ(recipe.normalizer, 0.002);
    Material m;
    materialize(recipe, faint, 20, m);
    EXPECT_LT(m.coverage(5, 5), 0.1f);
}

TEST(PrepareMaterial, RefusesWhatMakesNoSense) {
    Context context = copper_context(20, 20, 5);
    const Forecast forecast = persistence().forecast(context);
    MaterialOptions options;
    options.metallic_gamma = 0;
    EXPECT_THROW(prepare_material(context, forecast, options), Error);
    options = {};
    options.height_patina_weight = 1.5;
    EXPECT_THROW(prepare_material(context, forecast, options), Error);
    EXPECT_THROW(prepare_material(copper_context(21, 20, 5), forecast), Error);
    EXPECT_THROW(prepare_material(Context{}, forecast), Error);
}

}  // namespace
}  // namespace verdigris
