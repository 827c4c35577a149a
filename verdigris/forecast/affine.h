// SPDX-License-Identifier: MIT
// affinergb: one global drift of color, x(k) = x_last + k (S x_last + s), fitted in closed form.
// Based on: [Paper] Section 4 and Table 2; the exact simplification is docs/models/forecast.md.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "verdigris/forecast/forecast.h"

namespace verdigris {

enum class AffineFamily {
    full,         ///< 3x3 matrix and bias, 12 parameters
    per_channel,  ///< gain and bias per channel, 6
    single_gain,  ///< one gain and one bias, 2
};

enum class FitPixels { all, specimen };  ///< the paper fits all; clipped pixels never count

struct AffineOptions {
    AffineFamily family{AffineFamily::full};
    int order = 1;        ///< 0 holds (persistence exactly), 1 linear, 2 accelerating
    double ridge_k = 30;  ///< lambda = ridge_k * sigma^2; 0 reproduces the paper
    FitPixels pixels{FitPixels::all};
    bool clamp = true;  ///< see Trajectory::clamp
};

/// dx/dt = S x + s per unit of time (order 1), plus the same for the square term (order 2).
struct AffineDrift {
    std::array<std::array<double, 3>, 3> S{};
    std::array<double, 3> s{};
};
struct AffineFit {
    AffineDrift linear, quadratic;  ///< quadratic is zero unless order == 2
    double lambda = 0;              ///< the ridge used
    double sigma = 0;               ///< noise it was derived from
    std::int64_t pixels = 0;        ///< that counted
};

/// Least squares of the slope image on the first frame, in double, one pass. O(pixels * n).
/// A context of one frame, or one with no usable pixel, gives a zero drift.
AffineFit fit_affine(const Context& context, const AffineOptions& options = {});

/// fit_affine, applied to the last frame inside the specimen.
Forecaster affinergb(const AffineOptions& options = {});

/// "full" / "per-channel" / "single-gain".
std::string to_string(AffineFamily family);

}  // namespace verdigris
