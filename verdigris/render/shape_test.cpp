// SPDX-License-Identifier: MIT
#include "verdigris/render/shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/render/drape.h"
#include "verdigris/render/largest_rectangle.h"
#include "verdigris/render/settings.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

void expect_sound(const Shape& s) {
    ASSERT_EQ(s.normals.size(), s.vertex_count());
    ASSERT_EQ(s.tangents.size(), s.vertex_count());
    ASSERT_EQ(s.coordinates.size(), s.vertex_count());
    for (std::size_t i = 0; i < s.vertex_count(); ++i) {
        EXPECT_NEAR(length(s.normals[i]), 1, 1e-5f) << i;
        EXPECT_NEAR(length(s.tangents[i].direction), 1, 1e-5f) << i;
        EXPECT_NEAR(dot(s.normals[i], s.tangents[i].direction), 0, 1e-5f) << i;
        EXPECT_EQ(std::abs(s.tangents[i].sign), 1);
        EXPECT_GE(s.coordinates[i].u, 0);
        EXPECT_LE(s.coordinates[i].u, 1);
        EXPECT_GE(s.coordinates[i].v, 0);
        EXPECT_LE(s.coordinates[i].v, 1);
        EXPECT_LE(length(s.positions[i]), 1.5f);
    }
    for (const auto& t : s.triangles) {
        const auto at = [&](std::size_t c) { return s.positions[t[c]]; };
        const Vec3F face = cross(at(1) - at(0), at(2) - at(0));
        EXPECT_GT(length(face), 0);
        for (const std::uint32_t i : t) EXPECT_GT(dot(face, s.normals[i]), 0);
    }
}

TEST(Shapes, AreSound) {
    expect_sound(plate_shape(0.5));
    expect_sound(sphere_shape(48));
    expect_sound(drape_shape(160));
    expect_sound(make_setting(SceneKind::plate, 1.6).shape);
}

TEST(Shapes, PlateHasThePictureItsAspect) {
    const Shape wide = plate_shape(2);
    EXPECT_EQ(wide.positions[0], (Vec3F{-1, 0.5f, 0}));  // u = v = 0: above, to the left
    EXPECT_EQ(wide.positions[3], (Vec3F{1, -0.5f, 0}));
    EXPECT_EQ(plate_shape(0.5).positions[0], (Vec3F{-0.5f, 1, 0}));
}

TEST(Shapes, SphereShowsTheMiddleOfTheMapInFront) {
    const Shape s = sphere_shape(16);
    bool front = false;
    for (std::size_t i = 0; i < s.vertex_count(); ++i) {
        EXPECT_NEAR(length(s.positions[i]), 1, 1e-6f);
        if (s.positions[i].z > 0.9999f) {
            front = true;
            EXPECT_NEAR(s.coordinates[i].u, 0.5f, 1e-6f);
            EXPECT_NEAR(s.coordinates[i].v, 0.5f, 1e-6f);
            EXPECT_NEAR(s.tangents[i].direction.x, 1, 1e-5f);
        }
    }
    EXPECT_TRUE(front);
}

TEST(Shapes, DrapeDerivativesAreThoseOfItsPositions) {
    const double h = 1e-4;
    for (const double u : {0.07, 0.3, 0.51, 0.77, 0.96}) {
        for (const double v : {0.05, 0.4, 0.66, 0.93}) {
            const DrapePoint p = drape_point(u, v);
            const Vec3F du =
                (drape_point(u + h, v).position - drape_point(u - h, v).position) * float(0.5 / h);
            const Vec3F dv =
                (drape_point(u, v + h).position - drape_point(u, v - h).position) * float(0.5 / h);
            EXPECT_LT(length(du - p.along_u), 0.02f) << u << " " << v;
            EXPECT_LT(length(dv - p.along_v), 0.02f) << u << " " << v;
        }
    }
    const DrapePoint top = drape_point(0.5, 0.5);
    EXPECT_TRUE(std::isfinite(top.along_u.x + top.along_v.z + top.position.y));
}

TEST(Settings, NamesRoundTrip) {
    for (const SceneKind kind : {SceneKind::plate, SceneKind::sphere, SceneKind::drape}) {
        EXPECT_EQ(scene_kind_from(to_string(kind)), kind);
    }
    EXPECT_FALSE(scene_kind_from("teapot"));
}

TEST(Settings, ATurntableClosesAndAPlateNeverShowsItsBack) {
    const Setting plate = make_setting(SceneKind::plate, 1);
    const Setting sphere = make_setting(SceneKind::sphere, 1);
    EXPECT_NEAR(turntable_turn(plate, 0), plate.rest_turn, 0.01);
    EXPECT_NEAR(turntable_turn(plate, 0), turntable_turn(plate, 1), 1e-9);
    EXPECT_NEAR(turntable_turn(sphere, 1) - turntable_turn(sphere, 0), 2 * double(kPi), 1e-6);
    for (double phase = 0; phase < 1; phase += 0.05) {
        EXPECT_LT(std::abs(turntable_turn(plate, phase)), 1.2);
    }
}

TEST(Settings, AModelIsMovedIntoTheMiddle) {
    Shape far = sphere_shape(8);
    for (Vec3F& p : far.positions) p = p * 40 + Vec3F{1000, -2000, 500};
    const Setting s = make_setting(std::move(far));
    for (const Vec3F& p : s.shape.positions) EXPECT_NEAR(length(p), 1, 1e-3f);
}

TEST(LargestRectangle, KnownMasks) {
    Mask mask(300, 200);
    EXPECT_EQ(largest_rectangle({}, 30, 20), (Rect{0, 0, 30, 20}));
    EXPECT_EQ(largest_rectangle(mask, 300, 200), (Rect{0, 0, 300, 200}));  // nothing to hold on to
    for (int y = 20; y < 180; ++y) {
        for (int x = 90; x < 260; ++x) mask(x, y) = kInside;
    }
    for (int y = 0; y < 20; ++y) mask(150, y) = kInside;  // a wire that holds it
    const Rect r = largest_rectangle(mask, 300, 200);
    EXPECT_NEAR(r.x, 93, 3);  // a rim of 3 and 2 pixels is left out
    EXPECT_NEAR(r.y, 22, 3);
    EXPECT_NEAR(r.width, 164, 5);
    EXPECT_NEAR(r.height, 156, 5);
    for (int y = r.y; y < r.y + r.height; ++y) {
        for (int x = r.x; x < r.x + r.width; ++x) EXPECT_NE(mask(x, y), 0);
    }
    for (const int x : {90, 91, 92, 257, 258, 259}) {  // its last columns are no specimen any more
        for (int y = 0; y < 200; ++y) EXPECT_FALSE(x >= r.x && x < r.x + r.width) << x;
    }
    Mask full(300, 200);  // ends with the picture: nothing is cut off
    std::ranges::fill(full.pixels(), kInside);
    EXPECT_EQ(largest_rectangle(full, 300, 200), (Rect{0, 0, 300, 200}));
    mask(170, 100) = 0;  // a speck
    const Rect speck = largest_rectangle(mask, 300, 200);
    EXPECT_GT(speck.width * speck.height, 80 * 160);
}

}  // namespace
}  // namespace verdigris
