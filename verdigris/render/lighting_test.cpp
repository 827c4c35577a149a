// SPDX-License-Identifier: MIT
#include "verdigris/render/lighting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/files/image_file.h"
#include "verdigris/files/png.h"
#include "verdigris/files/testing.h"
#include "verdigris/render/settings.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

// A dim gradient with a small sun.
Image<LinearF> sunny(int height) {
    Image<LinearF> picture(2 * height, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < 2 * height; ++x) {
            picture(x, y) = {0.2f + 0.1f * float(y) / float(height), 0.3f, 0.4f};
        }
    }
    picture(height / 2, height / 4) = {900, 800, 700};
    return picture;
}

// Mean over even directions of the sphere.
template <class F>
double over_sphere(F f, int count = 1 << 16) {
    double sum = 0;
    for (std::uint32_t i = 0; i < std::uint32_t(count); ++i) {
        const UnitPoint u = sobol_point(i, 0, 21);
        const float y = 1 - 2 * u.x, r = std::sqrt(1 - y * y), phi = 2 * kPi * u.y;
        sum += double(f(Vec3F{r * std::cos(phi), y, r * std::sin(phi)}));
    }
    return sum / count * 4 * double(kPi);
}

TEST(SkyLight, LooksWhereThreeJsLooks) {
    Image<LinearF> picture(8, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) picture(x, y) = {float(x), float(y), 1};
    }
    const SkyLight sky(std::move(picture));
    EXPECT_NEAR(sky.radiance({1, 0, 0}).r, 3.5f, 1e-4f);  // the middle
    EXPECT_NEAR(sky.radiance({0, 0, 1}).r, 5.5f, 1e-4f);  // a quarter to the right
    EXPECT_NEAR(sky.radiance({0, 0, -1}).r, 1.5f, 1e-4f);
    EXPECT_NEAR(sky.radiance({0, 1, 0}).g, 0, 1e-4f);  // the top row is above
    EXPECT_NEAR(sky.radiance({0, -1, 0}).g, 3, 1e-4f);
}

TEST(SkyLight, DensityIntegratesToOne) {
    const SkyLight sky(sunny(64));
    EXPECT_NEAR(over_sphere([&](Vec3F d) { return sky.pdf(d); }, 1 << 20), 1, 0.02);
}

TEST(SkyLight, SamplesHaveTheDensityTheyClaim) {
    const SkyLight sky(sunny(64));
    // The mean of f / pdf over samples is the integral of f, whatever f is.
    for (const bool by_light : {false, true}) {
        double sum = 0;
        constexpr int kCount = 1 << 14;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const SkyLight::Sample s = sky.sample(sobol_point(i, 0, 4));
            EXPECT_NEAR(s.pdf, sky.pdf(s.direction), 1e-3f * s.pdf);
            const float f = by_light ? sky.radiance(s.direction).g : std::max(s.direction.y, 0.0f);
            sum += double(f / s.pdf);
        }
        const double wanted = by_light
                                  ? over_sphere([&](Vec3F d) { return sky.radiance(d).g; }, 1 << 20)
                                  : double(kPi);
        EXPECT_NEAR(sum / kCount, wanted, 0.03 * wanted) << by_light;
    }
}

TEST(SkyLight, WildPicturesAreTamedOrRefused) {
    Image<LinearF> wild(4, 2);
    for (LinearF& c : wild.pixels()) c = {-3, 1e30f, 0.5f};
    const SkyLight sky(std::move(wild));
    EXPECT_EQ(sky.radiance({1, 0, 0}).r, 0);
    EXPECT_FLOAT_EQ(sky.radiance({1, 0, 0}).g, 65504);
    EXPECT_EQ(error_of([] { SkyLight(Image<LinearF>(4, 2)); }).code(), ErrorCode::usage);
    EXPECT_EQ(error_of([] { SkyLight(Image<LinearF>{}); }).code(), ErrorCode::usage);
}

TEST(SkyLight, FilesInOneSentence) {
    const ScratchFolder folder;
    const auto sentence = [&](const std::filesystem::path& path) {
        const Error error = error_of([&] { read_sky_light(path); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        return std::string(error.what());
    };
    write_exr(folder / "sky.exr", sunny(16).view());
    EXPECT_NEAR(read_sky_light(folder / "sky.exr").radiance({0, -1, 0}).g, 0.3f, 1e-3f);
    write_exr(folder / "square.exr", Image<LinearF>(8, 8).view());
    EXPECT_NE(sentence(folder / "square.exr").find("twice as wide"), std::string::npos);
    write_exr(folder / "black.exr", Image<LinearF>(8, 4).view());
    EXPECT_NE(sentence(folder / "black.exr").find("black everywhere"), std::string::npos);
    EXPECT_NE(sentence(folder / "none.exr").find("none.exr"), std::string::npos);
    write_png(folder / "huge.png", Image<SrgbU8>(8200, 4100));
    EXPECT_NE(sentence(folder / "huge.png").find("8192 x 4096"), std::string::npos);
}

Lighting two_boxes() {
    return Lighting(SkyLight(sunny(32)), {{{0, 4, 0}, {1.5f, 0, 0}, {0, 0, 1}, gray(5), true},
                                          {{4, 1, 1}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}, false}});
}

TEST(Lighting, SamplesHaveTheDensityTheyClaim) {
    const Lighting lighting = two_boxes();
    const Vec3F at{0.2f, -0.3f, 0.1f}, normal = unit({0.3f, 0.9f, 0.2f});
    const auto weights = lighting.weights({at, normal, unit({0, 0.5f, 1}), 0.2f, 0.4f});
    double found = 0;
    constexpr int kCount = 1 << 15;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const Vec3F d = lighting.sample(at, weights, sobol_point(i, 0, 8));
        const Lighting::Light light = lighting.along(at, d, weights);
        ASSERT_GT(light.pdf, 0);
        found += double(light.radiance.g / light.pdf * std::max(dot(d, normal), 0.0f)) / kCount;
    }
    const double wanted = over_sphere(
        [&](Vec3F d) {
            return lighting.along(at, d, weights).radiance.g * std::max(dot(d, normal), 0.0f);
        },
        1 << 20);
    EXPECT_NEAR(found, wanted, 0.02 * wanted);
    const double whole =
        over_sphere([&](Vec3F d) { return lighting.along(at, d, weights).pdf; }, 1 << 20);
    EXPECT_NEAR(whole, 1, 0.02);
}

TEST(Lighting, ARectangleShinesToItsFrontOnly) {
    const Lighting lighting(SkyLight(gray(0)),
                            {{{0, 0, 3}, {0, 1, 0}, {1, 0, 0}, gray(2), false}});  // looks at -Z
    const Lighting::Weights none;
    EXPECT_EQ(lighting.along({}, {0, 0, 1}, none).radiance.r, 2);
    EXPECT_EQ(lighting.along({0, 0, 6}, {0, 0, -1}, none).radiance.r, 0);
    EXPECT_EQ(lighting.along({}, {0, 0, -1}, none).radiance.r, 0);
    EXPECT_EQ(lighting.along({}, unit({0.5f, 0, 1}), none).radiance.r, 0);  // past its edge
}

TEST(Lighting, TooManyOrEmptyRectanglesAreRefused) {
    const RectangleLight good{{0, 0, 3}, {0, 1, 0}, {1, 0, 0}, gray(2), false};
    const RectangleLight line{{0, 0, 3}, {0, 1, 0}, {0, 2, 0}, gray(2), false};
    EXPECT_EQ(error_of([&] { Lighting(SkyLight(gray(1)), {line}); }).code(), ErrorCode::usage);
    const std::vector<RectangleLight> nine(9, good);
    EXPECT_EQ(error_of([&] { Lighting(SkyLight(gray(1)), nine); }).code(), ErrorCode::usage);
}

TEST(Studio, NoLightLooksAwayFromTheObject) {
    const Lighting studio = studio_lighting();
    const Lighting::Weights w = studio.weights({{}, {0, 0, 1}, {0, 0, 1}, 1, 1});
    EXPECT_GT(w.sum, 0);
    EXPECT_GT(w.of[1], 0);
    EXPECT_GT(w.of[2], 0);
}

}  // namespace
}  // namespace verdigris
