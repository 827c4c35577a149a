// SPDX-License-Identifier: MIT
#include "verdigris/simulate/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verdigris/simulate/specimen.h"

namespace verdigris {
namespace {

SimulationSpec bare() {
    SimulationSpec spec;
    spec.frames = {.width = 200, .height = 120};
    spec.scene = SceneSpec{.width = 0.6,
                           .height = 0.5,
                           .corner = 0,
                           .backdrop = 0.4,
                           .backdrop_gradient = 0,
                           .light_gradient = 0,
                           .vignette = 0,
                           .texture = 0,
                           .shadow = 0};
    spec.grid = 16;
    return spec;
}

double area(const Mask& mask) {
    return double(std::count(mask.pixels().begin(), mask.pixels().end(), kInside));
}

TEST(Scene, TheSpecimenHasTheSizeAndPlaceThatWereAsked) {
    for (const double tilt : {0.0, 20.0, 90.0}) {
        SimulationSpec spec = bare();
        spec.scene.tilt = tilt;
        const Scene scene(spec, specimen_grid(spec));
        EXPECT_NEAR(area(scene.specimen()), 0.6 * 120 * 0.5 * 120, 60) << tilt;
        const auto m = scene.specimen_from_frame();
        EXPECT_NEAR(m.a * 100 + m.b * 60 + m.c, 0.6 / 0.5 / 2, 1e-12);
        EXPECT_NEAR(m.d * 100 + m.e * 60 + m.f, 0.5, 1e-12);
    }
}

TEST(Scene, TiltTurnsClockwise) {
    SimulationSpec spec = bare();
    spec.scene.tilt = 15;
    const Mask mask = Scene(spec, specimen_grid(spec)).specimen();
    // Clockwise on the screen lowers the right end of the top edge.
    const auto top = [&](int x) {
        int y = 0;
        while (y < 120 && !mask(x, y)) ++y;
        return y;
    };
    EXPECT_LT(top(80), top(120));
}

TEST(Scene, AnEvenSpecimenInEvenLightIsItsColor) {
    const SimulationSpec spec = bare();
    const CellGrid grid = specimen_grid(spec);
    const Scene scene(spec, grid);
    Image<LinearF> colors(grid.columns, grid.rows), frame;
    std::fill(colors.pixels().begin(), colors.pixels().end(), LinearF{0.5f, 0.25f, 0.125f});
    scene.compose(colors, frame);
    const Mask inside = scene.specimen(), reference = scene.reference();
    EXPECT_NEAR(frame(100, 60).r, 0.5f, 1e-6f);
    EXPECT_NEAR(frame(100, 60).b, 0.125f, 1e-6f);
    for (std::size_t i = 0; i < frame.pixel_count(); ++i) {
        if (reference.pixels()[i]) {
            EXPECT_FALSE(inside.pixels()[i]);
            EXPECT_NEAR(frame.pixels()[i].g, 0.4f, 1e-6f);
        }
    }
    EXPECT_GT(area(reference), 0.3 * double(reference.pixel_count()));
}

TEST(Scene, CellsAreSeenWhereTheyLie) {
    const SimulationSpec spec = bare();
    const CellGrid grid = specimen_grid(spec);
    Image<double> cells(grid.columns, grid.rows);
    for (int y = 0; y < grid.rows; ++y)
        for (int x = 0; x < grid.columns; ++x) cells(x, y) = grid.x(x) + 10 * grid.y(y);
    const Scene scene(spec, grid);
    const Image<float> map = scene.seen(cells);
    const auto m = scene.specimen_from_frame();
    for (const auto& [x, y] : {std::pair{90, 55}, std::pair{110, 70}, std::pair{75, 50}}) {
        const double px = x + 0.5, py = y + 0.5;
        const double sx = m.a * px + m.b * py + m.c, sy = m.d * px + m.e * py + m.f;
        EXPECT_NEAR(map(x, y), sx + 10 * sy, 1e-5);
    }
    EXPECT_EQ(map(2, 2), 0);
}

TEST(Scene, TheMountHoldsFromAboveAndIsNoReference) {
    SimulationSpec spec = bare();
    spec.scene.mount = true;
    spec.scene.mount_width = 0.2;
    const Scene scene(spec, specimen_grid(spec));
    const Mask mount = scene.mount(), reference = scene.reference(), inside = scene.specimen();
    EXPECT_GT(area(mount), 100);
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 200; ++x) {
            if (!mount(x, y)) continue;
            EXPECT_LT(y, 60);
            EXPECT_FALSE(reference(x, y));
            EXPECT_FALSE(inside(x, y));
        }
    }
}

TEST(Scene, LightFallsOffAsAsked) {
    SimulationSpec spec = bare();
    spec.scene.light_gradient = 0.2;
    spec.scene.light_direction = 0;
    const CellGrid grid = specimen_grid(spec);
    const Scene scene(spec, grid);
    Image<LinearF> colors(grid.columns, grid.rows), frame;
    scene.compose(colors, frame);
    // One short side of the frame apart: a fifth of the light in the middle.
    EXPECT_NEAR(frame(160, 2).g - frame(40, 2).g, 0.2f * 0.4f, 1e-5f);
    EXPECT_EQ(frame(40, 2).g, frame(40, 117).g);
}

TEST(Scene, PatternsOfTheBrushLieAlongTheirAngle) {
    SimulationSpec spec = bare();
    spec.scene.texture = 0.1;
    const CellGrid grid = specimen_grid(spec);
    const Scene scene(spec, grid);
    Image<LinearF> colors(grid.columns, grid.rows), frame;
    std::fill(colors.pixels().begin(), colors.pixels().end(), LinearF{0.5f, 0.5f, 0.5f});
    scene.compose(colors, frame);
    double along = 0, across = 0;
    for (int y = 40; y < 80; ++y) {
        for (int x = 75; x < 125; ++x) {
            along += std::abs(double(frame(x + 1, y).r - frame(x, y).r));
            across += std::abs(double(frame(x, y + 1).r - frame(x, y).r));
        }
    }
    EXPECT_GT(across, 5 * along);
    EXPECT_GT(across, 0);
}

}  // namespace
}  // namespace verdigris
