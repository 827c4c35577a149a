// SPDX-License-Identifier: MIT
// Conversions between encodings, named target_from_source so that chains read by eye.
// Sources: the sRGB curve and matrix, [IEC61966-2-1]; CIELAB, [CIE15].
#pragma once

#include <cstdint>

#include "verdigris/color/pixel_types.h"

namespace verdigris {

/// Decodes one channel; odd-symmetric for negative values, no clipping above 1.
float linear_from_srgb(float encoded);
/// Encodes one channel; the inverse of linear_from_srgb to 1e-6.
float srgb_from_linear(float linear);

LinearF linear_from_srgb(SrgbF c);
SrgbF srgb_from_linear(LinearF c);
Xyz xyz_from_linear(LinearF c);
LinearF linear_from_xyz(Xyz c);
Lab lab_from_xyz(Xyz c);
Xyz xyz_from_lab(Lab c);
Lab lab_from_srgb(SrgbF c);

/// Code values to [0, 1]: exact division by 255 or 65535.
SrgbF srgb_from_u8(SrgbU8 c);
SrgbF srgb_from_u16(SrgbU16 c);
/// [0, 1] to code values: clamped, rounded to nearest; NaN gives 0.
SrgbU8 u8_from_srgb(SrgbF c);
SrgbU16 u16_from_srgb(SrgbF c);
/// One number in [0, 1] to code values: clamped, rounded to nearest; NaN gives 0.
std::uint8_t u8_from_unit(float v);
std::uint16_t u16_from_unit(float v);

/// Luma of encoded sRGB with BT.709 weights [BT709]: the brightness the eye reads from a frame.
inline constexpr float kLumaR = 0.2126f, kLumaG = 0.7152f, kLumaB = 0.0722f;
inline float luma(SrgbF c) {
    return kLumaR * c.r + kLumaG * c.g + kLumaB * c.b;
}

}  // namespace verdigris
