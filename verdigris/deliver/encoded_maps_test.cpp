// SPDX-License-Identifier: MIT
#include "verdigris/deliver/encoded_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace verdigris {
namespace {

// Every direction of the upper half sphere on a grid, down to nearly horizontal.
Material all_directions() {
    Material material;
    const int n = 181;
    material.normal = Image<Vec3F>(n, n);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const float sx = 40.0f * (float(x) / float(n - 1) - 0.5f);
            const float sy = 40.0f * (float(y) / float(n - 1) - 0.5f);
            const float length = std::sqrt(sx * sx + sy * sy + 1);
            material.normal(x, y) = {sx / length, sy / length, 1 / length};
        }
    }
    return material;
}

TEST(NormalMaster, EightBitsKeepLengthAndStayBlue) {
    const Material material = all_directions();
    const Image<Vec3U8> map = eight_bit(normal_master(material));
    for (std::size_t i = 0; i < map.pixel_count(); ++i) {
        const Vec3U8 code = map.pixels()[i];
        const double x = code.x / 127.5 - 1, y = code.y / 127.5 - 1, z = code.z / 127.5 - 1;
        EXPECT_NEAR(std::sqrt(x * x + y * y + z * z), 1, 1.0 / 127);
        EXPECT_GT(code.z, 127);
        EXPECT_NEAR(x, material.normal.pixels()[i].x, 0.51 / 127.5);
        EXPECT_NEAR(y, material.normal.pixels()[i].y, 0.51 / 127.5);
    }
}

TEST(NormalMaster, FlatIsTheUsualBlue) {
    Material material;
    material.normal = Image<Vec3F>(1, 1);
    material.normal(0, 0) = {0, 0, 1};
    EXPECT_EQ(eight_bit(normal_master(material))(0, 0), (Vec3U8{128, 128, 255}));
}

TEST(FlipGreen, ChangesGreenOnly) {
    const Image<Vec3U16> gl = normal_master(all_directions());
    const Image<Vec3U8> gl8 = eight_bit(gl), dx8 = flip_green(gl8);
    const Image<Vec3U16> dx = flip_green(gl);
    for (std::size_t i = 0; i < gl.pixel_count(); ++i) {
        EXPECT_EQ(dx8.pixels()[i], (Vec3U8{gl8.pixels()[i].x, std::uint8_t(255 - gl8.pixels()[i].y),
                                           gl8.pixels()[i].z}));
        EXPECT_EQ(
            dx.pixels()[i],
            (Vec3U16{gl.pixels()[i].x, std::uint16_t(65535 - gl.pixels()[i].y), gl.pixels()[i].z}));
    }
}

TEST(EightBit, IsTheMasterRoundedForEveryCode) {
    Image<std::uint16_t> codes(256, 256);
    for (std::size_t i = 0; i < codes.pixel_count(); ++i) codes.pixels()[i] = std::uint16_t(i);
    const Image<std::uint8_t> rounded = eight_bit(codes);
    for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
        EXPECT_LE(std::abs(double(codes.pixels()[i]) / 257 - rounded.pixels()[i]), 0.5);
    }
    EXPECT_EQ(rounded.pixels()[65535], 255);
}

TEST(OrmMaster, PutsEachMapIntoItsChannel) {
    Material material;
    material.roughness = Image<float>(2, 1);
    material.metallic = Image<float>(2, 1);
    material.roughness(0, 0) = 0.25f;
    material.metallic(0, 0) = 1.0f;
    material.roughness(1, 0) = 2.0f;  // clamped
    const Image<Vec3U8> orm = eight_bit(orm_master(material));
    EXPECT_EQ(orm(0, 0), (Vec3U8{255, 64, 255}));
    EXPECT_EQ(orm(1, 0), (Vec3U8{255, 255, 0}));
}

}  // namespace
}  // namespace verdigris
