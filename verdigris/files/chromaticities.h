// SPDX-License-Identifier: MIT
// Linear light on other primaries, brought to those of sRGB. Used inside this room only.
#pragma once

#include <array>
#include <string>

#include "verdigris/color/pixel_types.h"

namespace verdigris {

/// CIE 1931 xy of the primaries and the white.
struct Chromaticities {
    std::array<double, 2> red{0.64, 0.33}, green{0.30, 0.60}, blue{0.15, 0.06},
        white{0.3127, 0.3290};
};

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// "ACEScg", "Rec.2020"; "custom" for what has no name.
std::string chromaticities_name(const Chromaticities& from);
bool is_srgb_primaries(const Chromaticities& from);
/// False where three primaries span no volume: nothing can be computed from them.
bool is_usable(const Chromaticities& from);
/// To linear light on sRGB primaries; the white is adapted by Bradford [Lam1985].
Matrix3 linear_from_chromaticities(const Chromaticities& from);
LinearF multiply(const Matrix3& m, LinearF c);

}  // namespace verdigris
