// SPDX-License-Identifier: MIT
// The fused kernel against the plain reference, and what must hold whatever the tiles and threads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "hwy/targets.h"
#include "verdigris/error.h"
#include "verdigris/forecast/affine.h"
#include "verdigris/material/gaussian.h"
#include "verdigris/material/reference.h"
#include "verdigris/material/testing.h"
#include "verdigris/material/tile.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

struct Case {
    Context context;
    Forecast forecast;
    MaterialRecipe recipe;
};

Case example(int width, int height, const MaterialOptions& options = {}) {
    Case c;
    c.context = copper_context(width, height, 6);
    c.forecast = straight_forecast(c.context, {-0.01f, 0.006f, 0.008f});
    c.recipe = prepare_material(c.context, c.forecast, options);
    return c;
}

template <class P>
bool same(const Image<P>& a, const Image<P>& b) {
    return a.same_size(b) && std::memcmp(a.row(0), b.row(0), a.byte_count()) == 0;
}

bool same(const Material& a, const Material& b) {
    return same(a.albedo, b.albedo) && same(a.normal, b.normal) && same(a.roughness, b.roughness) &&
           same(a.metallic, b.metallic) && same(a.height, b.height) && same(a.coverage, b.coverage);
}

TEST(Materialize, EqualsThePlainReference) {
    // Odd sizes, sizes below a vector and below the halo, a second tile of columns.
    for (const auto& [width, height] : {std::pair{37, 29}, std::pair{5, 3}, std::pair{16, 300},
                                        std::pair{2100, 20}, std::pair{1, 1}, std::pair{129, 70}}) {
        const Case c = example(width, height);
        for (double h : {0.0, 3.0, 12.0, 40.0}) {
            Material m;
            materialize(c.recipe, c.forecast.trajectory, h, m);
            const Material expected = reference::materialize(c.recipe, c.forecast.at(h));
            EXPECT_LT(reference::largest_difference(m, expected), 1e-5)
                << width << "x" << height << " at " << h;
        }
    }
}

TEST(Materialize, EqualsTheReferenceUnderOtherOptions) {
    MaterialOptions options;
    options.height_sigma = 0;
    options.micro_sigma = 0;
    EXPECT_GT(example(40, 40, options).recipe.normalizer, 0);
    for (const auto& [hs, ms] : {std::pair{0.0, 0.0}, std::pair{2.5, 0.4}, std::pair{0.3, 6.0}}) {
        options.height_sigma = hs;
        options.micro_sigma = ms;
        options.normal_gain = 1;
        options.coverage_exponent = 2;
        const Case c = example(61, 47, options);
        Material m;
        materialize(c.recipe, c.forecast, 10, m);
        EXPECT_LT(
            reference::largest_difference(m, reference::materialize(c.recipe, c.forecast.at(10))),
            1e-5);
    }
}

TEST(Materialize, FrameAndTrajectoryGiveTheSameBytes) {
    const Case c = example(70, 50);
    Material from_frame, from_law;
    materialize(c.recipe, c.forecast.at(7).view(), from_frame);
    materialize(c.recipe, c.forecast.trajectory, 7, from_law);
    EXPECT_TRUE(same(from_frame, from_law));
    EXPECT_TRUE(same(from_law.albedo, c.forecast.at(7)));
}

TEST(Materialize, WorksOnOrderTwoAndOnNetworks) {
    Context context = copper_context(50, 40, 6);
    AffineOptions options;
    options.order = 2;
    const Forecast second = affinergb(options).forecast(context);
    const MaterialRecipe recipe = prepare_material(context, second);
    Material m;
    materialize(recipe, second, 9, m);
    EXPECT_LT(reference::largest_difference(m, reference::materialize(recipe, second.at(9))), 1e-5);

    Forecast network;
    network.stack.base = context.frames.back().clone();
    network.stack.horizons = {5};
    network.stack.frames.push_back(second.at(5));
    const MaterialRecipe short_recipe = prepare_material(context, network);
    EXPECT_EQ(short_recipe.reference_horizon, 5);  // it knows nothing beyond
    materialize(short_recipe, network, 2.5, m);
    EXPECT_LT(
        reference::largest_difference(m, reference::materialize(short_recipe, network.at(2.5))),
        1e-5);
}

TEST(Materialize, StripsEqualTheWhole) {
    const Case c = example(90, 75);
    Material whole;
    materialize(c.recipe, c.forecast.trajectory, 11, whole);
    for (const auto& [columns, rows] : {std::pair{90, 7}, std::pair{31, 75}, std::pair{16, 1}}) {
        Material cut;
        materialize(c.recipe, c.forecast.trajectory, 0, cut);  // sized, and full of other numbers
        TileJob job;
        job.recipe = &c.recipe;
        job.trajectory = &c.forecast.trajectory;
        job.time = trajectory_time(c.forecast.trajectory, 11);
        job.height_taps = gaussian_taps(c.recipe.options.height_sigma);
        job.micro_taps = gaussian_taps(c.recipe.options.micro_sigma);
        job.width = 90;
        job.height = 75;
        job.out = &cut;
        for (int y = 0; y < 75; y += rows) {
            for (int x = 0; x < 90; x += columns) {
                materialize_tile(job, {x, y, std::min(columns, 90 - x), std::min(rows, 75 - y)});
            }
        }
        EXPECT_TRUE(same(cut, whole)) << columns << " " << rows;
    }
}

TEST(Materialize, SameBytesOnAnyNumberOfThreads) {
    const Case c = example(300, 280);
    Material one, all;
    set_thread_count(1);
    materialize(c.recipe, c.forecast.trajectory, 11, one);
    set_thread_count(0);
    materialize(c.recipe, c.forecast.trajectory, 11, all);
    EXPECT_TRUE(same(one, all));
}

TEST(Materialize, EveryInstructionSetGivesTheSameMaps) {
    const Case c = example(45, 31);
    Material best, other;
    materialize(c.recipe, c.forecast.trajectory, 11, best);
    int targets = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        materialize(c.recipe, c.forecast.trajectory, 11, other);
        EXPECT_LT(reference::largest_difference(best, other), 1e-5) << hwy::TargetName(target);
        // What is exact must be exact everywhere.
        const MaterialRecipe recipe = prepare_material(c.context, c.forecast);
        materialize(recipe, c.forecast.trajectory, 0, other);
        for (float p : other.coverage.pixels()) ASSERT_EQ(p, 0.0f) << hwy::TargetName(target);
        ++targets;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(targets, 1);
}

TEST(Materialize, ReusesItsOutput) {
    const Case c = example(64, 64);
    Material m;
    materialize(c.recipe, c.forecast.trajectory, 1, m);
    const float* roughness = m.roughness.row(0);
    const Vec3F* normal = m.normal.row(0);
    materialize(c.recipe, c.forecast.trajectory, 2, m);
    EXPECT_EQ(m.roughness.row(0), roughness);
    EXPECT_EQ(m.normal.row(0), normal);
}

TEST(Materialize, NoNumberIsLostOnDegenerateFrames) {
    for (const SrgbF color : {SrgbF{0, 0, 0}, SrgbF{1, 1, 1}, SrgbF{0.5f, 0.5f, 0.5f}}) {
        for (double tau : {0.0, 0.002}) {
            Context context;
            for (int t = 0; t < 5; ++t) context.frames.push_back(flat(33, 21, color));
            context.tau = tau;
            const Forecast still = persistence().forecast(context);
            const MaterialRecipe recipe = prepare_material(context, still);
            EXPECT_EQ(recipe.normalizer, 1);
            Material m;
            materialize(recipe, still, 50, m);
            for (std::size_t i = 0; i < m.normal.pixel_count(); ++i) {
                EXPECT_EQ(m.normal.pixels()[i], (Vec3F{0, 0, 1}));
                EXPECT_NEAR(m.roughness.pixels()[i], 0.16f, 1e-6f);
                EXPECT_NEAR(m.metallic.pixels()[i], 0.97f, 1e-6f);
                EXPECT_EQ(m.coverage.pixels()[i], 0);
            }
        }
    }
}

TEST(Materialize, RefusesWhatDoesNotFit) {
    Case c = example(20, 20);
    Material m;
    EXPECT_THROW(materialize(c.recipe, Image<SrgbF>(21, 20).view(), m), Error);
    EXPECT_THROW(materialize(c.recipe, c.forecast.trajectory, -1, m), Error);
    c.recipe.options.micro_range = 0;
    EXPECT_THROW(materialize(c.recipe, c.forecast.trajectory, 1, m), Error);
    c.recipe.options.micro_range = 0.02;
    c.recipe.options.micro_sigma = 11;
    EXPECT_THROW(materialize(c.recipe, c.forecast.trajectory, 1, m), Error);
    c.recipe.options.micro_sigma = std::nan("");
    EXPECT_THROW(materialize(c.recipe, c.forecast.trajectory, 1, m), Error);
}

}  // namespace
}  // namespace verdigris
