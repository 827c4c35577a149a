// SPDX-License-Identifier: MIT
#include "verdigris/render/render.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "verdigris/files/testing.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/settings.h"
#include "verdigris/render/testing.h"
#include "verdigris/render/tone_map.h"
#include "verdigris/render/tracer.h"

namespace verdigris {
namespace {

TEST(Render, AMattePlateUnderEvenLightShowsItsAlbedo) {
    // Straight from the front; the plate fills the picture. Lambert under a coat of F0 0.04 at
    // roughness 1 reflects its color, less what the coat keeps to itself.
    const LinearF color{0.5f, 0.2f, 0.8f};
    TestScene t(plate_shape(1), even_material(color, 1, 0), even_light(2));
    t.view = {{0, 0, 3}, {}, 20};
    const LinearF c = t.rendered(16, 256).light(8, 8);
    // The coat is white and lies over all three: what is left is proportional to the color.
    const float coat = (c.r * 0.8f - c.b * 0.5f) / (0.8f - 0.5f) / 2;
    EXPECT_GT(coat, 0.01f);
    EXPECT_LT(coat, 0.06f);
    EXPECT_NEAR(c.r / 2, coat + (1 - coat) * color.r, 0.01f);
    EXPECT_NEAR(c.g / 2, coat + (1 - coat) * color.g, 0.01f);
    EXPECT_NEAR(c.b / 2, coat + (1 - coat) * color.b, 0.01f);
}

TEST(Render, NothingCanBeSeenInAWhiteFurnace) {
    for (const float metallic : {0.0f, 1.0f}) {
        for (const float roughness : {0.1f, 0.5f, 1.0f}) {
            TestScene t(sphere_shape(64), even_material(gray(1), roughness, metallic),
                        even_light(1));
            const Rendering r = t.rendered(24, 512);
            for (int y = 4; y < 20; ++y) {
                for (int x = 4; x < 20; ++x) {
                    if (std::hypot(x - 11.5, y - 11.5) < 7) {
                        EXPECT_NEAR(r.light(x, y).g, 1, 0.03f)
                            << "metallic " << metallic << ", roughness " << roughness;
                    }
                }
            }
        }
    }
}

TEST(Render, AMirrorShowsTheSurroundings) {
    Image<LinearF> picture(256, 128);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 256; ++x) {
            picture(x, y) = {0.5f + 0.5f * std::sin(float(x) * 0.1f), float(y) / 128, 0.3f};
        }
    }
    const SkyLight sky(picture.clone());
    TestScene t(plate_shape(1), even_material(gray(1), 0, 1),
                Lighting(SkyLight(std::move(picture)), {}));
    t.view = {{1.2f, 0.9f, 2.6f}, {}, 20};
    const Rendering r = t.rendered(16, 128);
    const Vec3F in = unit(-t.view.position);
    const LinearF wanted = sky.radiance({in.x, in.y, -in.z});  // mirrored at z
    const LinearF seen = (r.light(7, 7) + r.light(8, 8) + r.light(7, 8) + r.light(8, 7)) * 0.25f;
    EXPECT_NEAR(seen.r, wanted.r, 0.02f);
    EXPECT_NEAR(seen.g, wanted.g, 0.02f);
}

TEST(Render, RectanglesAreAsBrightAsTheFormulaSays) {
    // A small even rectangle at distance 4, straight above a matte plate that is looked at from
    // the front: radiance of the plate = albedo / pi * L * area * cos cos / d^2.
    TestScene t(
        plate_shape(1), even_material(gray(0.5f), 1, 0),
        Lighting(SkyLight(gray(0)), {{{0, 0, 4}, {0, 0.1f, 0}, {0.1f, 0, 0}, gray(100), false}}));
    t.view = {{3, 0, 3}, {}, 4};
    const float seen = t.rendered(16, 256).light(8, 8).g;
    const float lambert = 0.5f / kPi * 100 * 0.04f / 16;
    EXPECT_GT(seen, lambert * 0.9f);
    EXPECT_LT(seen, lambert * 1.2f);  // and the coat of F0 0.04
}

// A bump in the middle: its slopes lean away from it. Light from +U must fall on the right slope.
Material bump(int side) {
    Material m = even_material(gray(0.6f), 0.9f, 0, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float dx = (float(x) + 0.5f) / float(side) - 0.5f;
            const float dy = 0.5f - (float(y) + 0.5f) / float(side);  // up
            const float height = std::exp(-40 * (dx * dx + dy * dy));
            m.normal(x, y) = unit({8 * dx * height, 8 * dy * height, 1});  // minus the gradient
        }
    }
    return m;
}

float mean_of(const Rendering& r, int x0, int y0, int x1, int y1) {
    float sum = 0;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) sum += r.light(x, y).g;
    }
    return sum / float((x1 - x0) * (y1 - y0));
}

TEST(Render, ABumpLitFromTheRightOrFromAboveLooksRaised) {
    const auto lit_from = [&](Vec3F at, Vec3F half_width, Vec3F half_height, double turn) {
        TestScene t(
            plate_shape(1), bump(64),
            Lighting(SkyLight(gray(0.05f)), {{at, half_width, half_height, gray(20), true}}));
        t.view = {{0, 0, 5}, {}, 20};
        RenderScene scene = t.scene();
        scene.turn = turn;
        RenderOptions options{.width = 40, .height = 40, .tolerance = 0, .most_samples = 64};
        return render(scene, options);
    };
    const Rendering right = lit_from({5, 0, 1}, {0, 1, 0}, {0, 0, -1}, 0);
    // cross(+Y, -Z) = -X: it shines to the left.
    EXPECT_GT(mean_of(right, 22, 16, 28, 24), 1.3f * mean_of(right, 12, 16, 18, 24));
    const Rendering above = lit_from({0, 5, 1}, {1, 0, 0}, {0, 0, 1}, 0);
    // cross(+X, +Z) = -Y: it shines down.
    EXPECT_GT(mean_of(above, 16, 12, 24, 18), 1.3f * mean_of(above, 16, 22, 24, 28));
    // Turned by a quarter of a half the frame turns with the plate.
    const Rendering turned = lit_from({5, 0, 1}, {0, 1, 0}, {0, 0, -1}, 0.3);
    EXPECT_GT(mean_of(turned, 22, 16, 28, 24), 1.2f * mean_of(turned, 12, 16, 18, 24));
    // From behind a bump is a hollow: its far slope catches the light.
    const double half = std::numbers::pi;
    const Rendering behind = lit_from({5, 0, 1}, {0, 1, 0}, {0, 0, -1}, half);
    EXPECT_GT(mean_of(behind, 12, 16, 18, 24), 1.3f * mean_of(behind, 22, 16, 28, 24));
    const Rendering behind_above = lit_from({0, 5, 1}, {1, 0, 0}, {0, 0, 1}, half);
    EXPECT_GT(mean_of(behind_above, 16, 22, 24, 28), 1.3f * mean_of(behind_above, 16, 12, 24, 18));
}

TEST(Render, TheFirstRowOfAMapIsAbove) {
    Material m = even_material(gray(0.1f), 1, 0, 8);
    for (int x = 0; x < 8; ++x) m.albedo(x, 0) = {1, 0, 0};
    for (int y = 0; y < 8; ++y) m.albedo(0, y) = {0, 0, 1};
    TestScene t(plate_shape(1), m, even_light(1));
    t.view = {{0, 0, 5}, {}, 22.6};
    const Rendering r = t.rendered(32);
    EXPECT_GT(r.light(16, 1).r, 3 * r.light(16, 30).r);
    EXPECT_GT(r.light(1, 16).b, 3 * r.light(30, 16).b);
}

TEST(Render, FoldsShadeThemselvesAndLightComesBackFromThem) {
    // A cup: a sphere seen from within its open side would be; the drape's inside stands in. With
    // no bounce light is lost, with more there is more of it, and never more than in a furnace.
    TestScene t(drape_shape(96), even_material(gray(1), 0.6f, 1), even_light(1));
    t.view = make_setting(SceneKind::drape, 1).view;
    const auto mean = [&](int bounces) {
        RenderOptions o{
            .width = 32, .height = 32, .tolerance = 0, .most_samples = 32, .bounces = bounces};
        const Rendering r = render(t.scene(), o);
        double sum = 0, hit = 0;
        for (const LinearF& c : r.light.pixels()) {
            sum += double(c.g);
            hit += c.g > 0;
        }
        EXPECT_LE(sum, 1.005 * hit) << "more than the furnace gives";
        return sum;
    };
    const double none = mean(0), three = mean(3), many = mean(16);
    EXPECT_LT(none, three);
    EXPECT_LE(three, many * 1.001);
    EXPECT_GT(three, 0.98 * many);  // three are enough
}

TEST(Render, SameBytesOnAnyNumberOfThreads) {
    TestScene t(drape_shape(64), even_material({0.9f, 0.6f, 0.5f}, 0.3f, 1), studio_lighting());
    t.view = make_setting(SceneKind::drape, 1).view;
    RenderOptions o{.width = 48, .height = 40, .tolerance = 1, .most_samples = 64};
    set_thread_count(1);
    const Tracer one(t.shape);
    RenderScene scene = t.scene();
    scene.tracer = &one;
    const Rendering first = render(scene, o);
    for (const int threads : {2, 5}) {
        set_thread_count(threads);
        const Tracer other(t.shape);
        scene.tracer = &other;
        const Rendering again = render(scene, o);
        EXPECT_EQ(std::memcmp(first.light.row(0), again.light.row(0), first.light.byte_count()), 0)
            << threads;
        EXPECT_EQ(first.samples, again.samples);
    }
    set_thread_count(0);
}

TEST(Render, NoiseIsBelowTheToleranceThatWasAskedFor) {
    TestScene t(sphere_shape(), even_material({0.87f, 0.63f, 0.53f}, 0.3f, 1), studio_lighting());
    t.view = make_setting(SceneKind::sphere, 1).view;
    RenderOptions o{.width = 64, .height = 64, .tolerance = 3};
    const Rendering quick = render(t.scene(), o);
    o.tolerance = 0;
    o.most_samples = 512;
    o.seed = 1;
    const Rendering slow = render(t.scene(), o);
    double square = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const SrgbF a = srgb_from_linear(pbr_neutral(quick.light(x, y)));
            const SrgbF b = srgb_from_linear(pbr_neutral(slow.light(x, y)));
            square += std::pow(double(a.g - b.g) * 255, 2) / (64 * 64);
        }
    }
    EXPECT_LT(std::sqrt(square), 2);
    EXPECT_GT(std::sqrt(square), 0.02);  // it was not simply rendered to the end
    EXPECT_LT(quick.samples, slow.samples / 8);
}

TEST(Render, NoiseIsJudgedAsThePictureWillBeDeveloped) {
    TestScene t(sphere_shape(), even_material({0.3f, 0.2f, 0.1f}, 0.5f, 1), studio_lighting());
    t.view = make_setting(SceneKind::sphere, 1).view;
    const auto samples = [&](double exposure) {
        return render(t.scene(), {.width = 48, .height = 48, .exposure = exposure}).samples;
    };
    EXPECT_GT(double(samples(3)), 1.3 * double(samples(0)));
    EXPECT_LE(samples(-6), samples(0));
}

TEST(Render, LooksStraightDownToo) {
    TestScene t(plate_shape(1), even_material(gray(1), 1, 1), even_light(1));
    t.view = {{0, 5, 0}, {}, 26};
    RenderScene scene = t.scene();
    scene.backdrop = {gray(0.5f), gray(0.5f)};
    const Rendering seen = render(scene, {.width = 8, .height = 8});
    for (const LinearF& c : seen.light.pixels()) {
        EXPECT_NEAR(c.g, 0.5f, 0.51f);  // a number; the plate is seen from its edge
        EXPECT_TRUE(std::isfinite(c.g));
    }
}

TEST(Render, NonsenseIsRefused) {
    TestScene t(plate_shape(1), even_material(gray(1), 1, 0), even_light(1));
    const auto code = [&](RenderOptions o, bool whole = true) {
        RenderScene scene = t.scene();
        if (!whole) scene.maps = nullptr;
        return error_of([&] { render(scene, o); }).code();
    };
    EXPECT_EQ(code({.width = 0}), ErrorCode::usage);
    EXPECT_EQ(code({.height = 20000}), ErrorCode::usage);
    EXPECT_EQ(code({.most_samples = 100}), ErrorCode::usage);
    EXPECT_EQ(code({.tolerance = -1}), ErrorCode::usage);
    EXPECT_EQ(code({.bounces = -1}), ErrorCode::usage);
    EXPECT_EQ(code({.exposure = std::nan("")}), ErrorCode::usage);
    EXPECT_EQ(code({}, false), ErrorCode::usage);
    for (const Viewpoint& view : {Viewpoint{{1, 2, 3}, {1, 2, 3}, 26}, Viewpoint{{0, 0, 5}, {}, 0},
                                  Viewpoint{{0, 0, 5}, {}, 180}}) {
        t.view = view;
        EXPECT_EQ(code({}), ErrorCode::usage);
    }
    EXPECT_EQ(error_of([] { SurfaceMaps(Material{}); }).code(), ErrorCode::usage);
}

TEST(Render, ATracerDoesNotTakeTheOtherThreads) {
    const auto allowed = [] {
        return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    };
    const std::size_t before = allowed();
    const Tracer tracer(sphere_shape());
    EXPECT_EQ(allowed(), before);
}

TEST(Render, StopsWhenAsked) {
    TestScene t(plate_shape(1), even_material(gray(1), 1, 0), even_light(1));
    const Error error = error_of([&] {
        render(t.scene(), {.width = 32, .height = 32},
               [](std::string_view, std::int64_t, std::int64_t) { return false; });
    });
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
    // And not only before it begins: 64 tiles of one pass are no single step.
    int asked = 0;
    render(t.scene(), {.width = 128, .height = 128, .tolerance = 64, .most_samples = 8},
           [&](std::string_view, std::int64_t, std::int64_t) {
               ++asked;
               return true;
           });
    EXPECT_GE(asked, 5);
}

}  // namespace
}  // namespace verdigris
