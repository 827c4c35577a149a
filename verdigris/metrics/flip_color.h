// SPDX-License-Identifier: MIT
// The color spaces of FLIP and the scale of its color error, as one table of numbers for the kernel
// (internal).
#pragma once

#include <array>

namespace verdigris {

/// Rows of 3 x 3 matrices one after the other. Luminance Y is that of a white of 1; red-green is
/// X / Xw - Y and blue-yellow Y - Z / Zw: YCxCz without its factors and offset, which linear
/// filters of sum 1 do not see.
struct FlipColor {
    std::array<float, 9> opponent_from_linear{};
    std::array<float, 9> linear_from_opponent{};
    std::array<float, 9> relative_xyz_from_linear{};  ///< X / Xw, Y, Z / Zw
    /// Errors d^0.7 below `knee` are d^0.7 * slope; above, at_knee + (d^0.7 - knee) * upper_slope.
    float knee = 0, slope = 0, at_knee = 0, upper_slope = 0;
};

inline constexpr double kFlipColorPower = 0.7;

/// Computed once. Source: [Andersson2020], Section 4.1.
const FlipColor& flip_color();

}  // namespace verdigris
