// SPDX-License-Identifier: MIT
// A pixel carries its encoding in its type, so that encoded and linear light cannot be mixed up:
// Image<SrgbF> does not convert to Image<LinearF> (tests/misuse proves it).
#pragma once

#include <cstdint>

namespace verdigris {

/// Encoded sRGB (IEC 61966-2-1), nominally in [0, 1]. The forecast and the paper's metrics work
/// here; the paper never linearizes.
struct SrgbF {
    float r = 0, g = 0, b = 0;
    bool operator==(const SrgbF&) const = default;
};

/// Encoded sRGB, code values 0..255.
struct SrgbU8 {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const SrgbU8&) const = default;
};

/// Encoded sRGB, code values 0..65535.
struct SrgbU16 {
    std::uint16_t r = 0, g = 0, b = 0;
    bool operator==(const SrgbU16&) const = default;
};

/// Linear light on sRGB/BT.709 primaries, D65; 1 is the reference white. Shading works here.
struct LinearF {
    float r = 0, g = 0, b = 0;
    bool operator==(const LinearF&) const = default;
};

/// CIE 1931 XYZ, 2 degree observer, D65 white at Y = 1.
struct Xyz {
    float x = 0, y = 0, z = 0;
};

/// CIE 1976 L*a*b* under D65: L in [0, 100], a and b roughly in [-128, 128].
struct Lab {
    float l = 0, a = 0, b = 0;
};

static_assert(sizeof(SrgbF) == 12 && sizeof(SrgbU8) == 3 && sizeof(SrgbU16) == 6);

}  // namespace verdigris
