// SPDX-License-Identifier: MIT
#include "verdigris/render/material_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/png.h"
#include "verdigris/files/testing.h"
#include "verdigris/render/surface_maps.h"
#include "verdigris/render/testing.h"

namespace verdigris {
namespace {

template <class P>
Image<P> even(P value, int width = 6, int height = 4) {
    Image<P> image(width, height);
    std::ranges::fill(image.pixels(), value);
    return image;
}

// Of a chunk's name and data [PNG, Annex D].
std::uint32_t crc_of(std::span<const std::byte> bytes) {
    std::uint32_t crc = ~0u;
    for (const std::byte b : bytes) {
        crc ^= std::uint32_t(b);
        for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320u : 0);
    }
    return ~crc;
}

class MaterialFolder : public testing::Test {
  protected:
    std::string sentence() {
        const Error error = error_of([&] { read_material_folder(folder_.path()); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        return error.what();
    }
    ScratchFolder folder_;
};

TEST_F(MaterialFolder, ReadsWhatDeliverWrites) {
    write_png(folder_ / "Cu_u010_Color.png", even(SrgbU8{255, 128, 0}));
    write_png(folder_ / "Cu_u010_NormalGL.png", even(Vec3U8{128, 200, 230}));
    write_png(folder_ / "Cu_u010_Roughness.png", even(std::uint8_t(51)));
    write_png(folder_ / "Cu_u010_Metalness.png", even(std::uint8_t(255)));
    write_png(folder_ / "Cu_u010_ORM.png", even(Vec3U8{255, 0, 0}));  // the single maps come first
    write_png(folder_ / "Cu_u010_Displacement.png", even(std::uint16_t(7)));
    write_png(folder_.path() / "masters16" / "Cu_u010_Roughness.png", even(std::uint16_t(13000)));
    EXPECT_TRUE(is_material_folder(folder_.path()));
    const Material m = read_material_folder(folder_.path());
    EXPECT_NEAR(m.albedo(5, 3).g, 128 / 255.0f, 1e-6f);
    EXPECT_NEAR(m.roughness(0, 0), 13000 / 65535.0f, 1e-6f);  // the 16-bit one
    EXPECT_EQ(m.metallic(2, 2), 1);
    EXPECT_GT(m.normal(1, 1).y, 0.4f);
    EXPECT_NEAR(length(m.normal(1, 1)), 1, 1e-5f);
}

TEST_F(MaterialFolder, OrmAloneAndNormalsOfDirectX) {
    write_png(folder_ / "a_BaseColor.png", even(SrgbU8{10, 20, 30}));
    write_png(folder_ / "a_NormalDX.png", even(Vec3U8{128, 200, 230}));
    write_png(folder_ / "a_ORM.png", even(Vec3U8{255, 102, 204}));
    const Material m = read_material_folder(folder_.path());
    EXPECT_NEAR(m.roughness(0, 0), 0.4f, 1e-6f);
    EXPECT_NEAR(m.metallic(0, 0), 0.8f, 1e-6f);
    EXPECT_LT(m.normal(0, 0).y, -0.4f);
}

TEST_F(MaterialFolder, WhatIsMissingIsNamed) {
    EXPECT_NE(sentence().find("_Color"), std::string::npos);
    EXPECT_FALSE(is_material_folder(folder_.path()));
    EXPECT_FALSE(is_material_folder(folder_ / "nowhere"));
    write_png(folder_ / "a_Color.png", even(SrgbU8{10, 20, 30}));
    EXPECT_NE(sentence().find("_Roughness"), std::string::npos);
    write_png(folder_ / "a_Roughness.png", even(std::uint8_t(9), 7, 4));
    EXPECT_NE(sentence().find("7 x 4 pixels, but the color has 6 x 4"), std::string::npos);
    write_png(folder_ / "a_Roughness.png", even(std::uint8_t(9)));
    EXPECT_EQ(read_material_folder(folder_.path()).metallic(0, 0), 0);
    EXPECT_EQ(read_material_folder(folder_.path()).normal(0, 0), (Vec3F{0, 0, 1}));
    write_png(folder_ / "b_Color.png", even(SrgbU8{10, 20, 30}));
    EXPECT_NE(sentence().find("both a_Color.png and b_Color.png"), std::string::npos);
}

TEST_F(MaterialFolder, AnImmenseMapIsRefusedBeforeItIsDecoded) {
    // A header of 16384 x 8192 and nothing behind it: decoding would say "truncated".
    write_png(folder_ / "a_Color.png", even(std::uint8_t(9)));
    std::vector<std::byte> bytes = read_file(folder_ / "a_Color.png");
    const std::array<unsigned, 8> size{0, 0, 0x40, 0, 0, 0, 0x20, 0};
    for (std::size_t i = 0; i < 8; ++i) bytes[16 + i] = std::byte(size[i]);
    const std::uint32_t crc = crc_of(std::span(bytes).subspan(12, 17));
    for (std::size_t i = 0; i < 4; ++i) bytes[29 + i] = std::byte(crc >> (24 - 8 * i));
    write_file(folder_ / "a_Color.png", bytes);
    write_png(folder_ / "a_Roughness.png", even(std::uint8_t(9)));
    EXPECT_NE(sentence().find("a_Color.png: has 16384 x 8192 pixels; a map may have 8192 x 8192"),
              std::string::npos);
}

TEST_F(MaterialFolder, ADamagedMapIsNamed) {
    write_file(folder_ / "a_Color.png", std::string_view("no picture"));
    write_png(folder_ / "a_Roughness.png", even(std::uint8_t(9)));
    EXPECT_NE(sentence().find("a_Color.png"), std::string::npos);
}

TEST(SurfaceMaps, InterpolatesLinearLightBetweenTexelCenters) {
    Material m = even_material(gray(0), 0.25f, 1, 2);
    m.albedo(1, 0) = m.albedo(1, 1) = {1, 1, 1};
    const SurfaceMaps maps(m);
    EXPECT_NEAR(maps.at(0.25f, 0.5f, Beyond::edge).surface.base_color.g, 0, 1e-5f);
    EXPECT_NEAR(maps.at(0.5f, 0.5f, Beyond::edge).surface.base_color.g, 0.5f, 1e-5f);
    EXPECT_NEAR(maps.at(0.75f, 0.5f, Beyond::edge).surface.base_color.g, 1, 1e-5f);
    EXPECT_NEAR(maps.at(0, 0.5f, Beyond::edge).surface.base_color.g, 0, 1e-5f);
    EXPECT_NEAR(maps.at(0, 0.5f, Beyond::repeat).surface.base_color.g, 0.5f, 1e-5f);
    EXPECT_NEAR(maps.at(-3.25f, 9.1f, Beyond::repeat).surface.base_color.g, 1, 1e-4f);
    EXPECT_NEAR(maps.at(0.3f, 0.3f, Beyond::edge).surface.roughness, 0.25f, 1e-5f);
    EXPECT_EQ(maps.at(0.3f, 0.3f, Beyond::edge).normal, (Vec3F{0, 0, 1}));
    const float nan = std::nanf("");
    EXPECT_TRUE(std::isfinite(maps.at(nan, 1e30f, Beyond::repeat).surface.roughness));
}

TEST(SurfaceMaps, APartOfThem) {
    Material m = even_material(gray(0), 0.25f, 1, 4);
    m.roughness(2, 1) = 0.75f;
    const SurfaceMaps maps(m, {2, 1, 1, 2});
    EXPECT_EQ(maps.width(), 1);
    EXPECT_NEAR(maps.at(0.5f, 0.1f, Beyond::edge).surface.roughness, 0.75f, 1e-4f);
    EXPECT_EQ(error_of([&] { SurfaceMaps(m, {3, 0, 2, 1}); }).code(), ErrorCode::usage);
}

}  // namespace
}  // namespace verdigris
