// SPDX-License-Identifier: MIT
// What a least-squares fit of a slope image on the first frame needs to know (internal).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

using Matrix3 = std::array<std::array<double, 3>, 3>;
using Triple = std::array<double, 3>;

/// Of the pixels inside a mask: x is the first frame, v(x) = sum_i weights[i] x_i the slope image.
struct SlopeMoments {
    double pixels = 0;
    Triple mean_x{}, mean_v{};
    Matrix3 cov_x{};   ///< of x with x, divided by `pixels`
    Matrix3 cov_vx{};  ///< row: channel of v, column: channel of x
};

/// One pass in double, centered on the way; the sums are combined in a fixed order.
SlopeMoments slope_moments(std::span<const Image<SrgbF>> frames, const Mask& where,
                           std::span<const double> weights);

/// Weights that turn n values at t = 0..n-1 into the coefficient of t^power of their least-squares
/// polynomial of the given order: a row of the Vandermonde pseudo-inverse.
std::vector<double> polynomial_weights(int n, int order, int power);

}  // namespace verdigris
