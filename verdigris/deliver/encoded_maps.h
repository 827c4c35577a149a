// SPDX-License-Identifier: MIT
// Maps as file pixels. The 16-bit master is made first and every 8-bit map is rounded from it, so
// the two agree to half a step everywhere. No dither: it would move 8-bit values up to one step
// away from the master.
#pragma once

#include <cstdint>

#include "verdigris/color/pixel_types.h"
#include "verdigris/material/material.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

Image<SrgbU16> color_master(const Material& material);
/// n * 32767.5 + 32767.5, +Y up (OpenGL). Blue is above one half wherever z > 0, and the length of
/// the decoded 8-bit vector is 1 +- 1/127.
Image<Vec3U16> normal_master(const Material& material);
/// R occlusion (1 everywhere: one camera sees no cavities), G roughness, B metallic: the order of
/// glTF, so one image serves both of its slots.
Image<Vec3U16> orm_master(const Material& material);
/// One number in [0, 1] per pixel.
Image<std::uint16_t> gray_master(const Image<float>& map);

/// Green turned around: +Y up to +Y down (DirectX). G' = max - G exactly, nothing else differs.
Image<Vec3U16> flip_green(const Image<Vec3U16>& normal);
Image<Vec3U8> flip_green(const Image<Vec3U8>& normal);

/// Rounded to nearest: 65535 -> 255.
inline std::uint8_t u8_from_u16(std::uint16_t v) {
    return std::uint8_t((v + 128u) / 257u);
}
Image<SrgbU8> eight_bit(const Image<SrgbU16>& master);
Image<Vec3U8> eight_bit(const Image<Vec3U16>& master);
Image<std::uint8_t> eight_bit(const Image<std::uint16_t>& master);

}  // namespace verdigris
