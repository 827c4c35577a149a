// SPDX-License-Identifier: MIT
// LDR-FLIP [Andersson2020]: how large the difference looks to somebody who flips between two
// pictures on one spot of a screen. Constants and order of operations as in version 1.6 of its
// authors' code.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// How many pixels are in a degree of the field of view, seen from `meters` away on a screen that
/// is `screen_meters` wide and has `screen_pixels` columns.
double pixels_per_degree(double meters, double screen_meters, double screen_pixels);

/// FLIP's own conditions: 0.7 m from a 0.7 m wide screen of 3840 columns; 67.02.
inline constexpr double kFlipPixelsPerDegree = 67.02064327658226;
/// Below, the filters are narrower than a pixel; above, no screen is that fine (chosen).
inline constexpr double kFlipSmallestPpd = 1, kFlipLargestPpd = 400;

struct FlipOptions {
    double pixels_per_degree = kFlipPixelsPerDegree;
};

struct FlipResult {
    Image<float> map;  ///< per pixel, 0 (no difference seen) to 1 (the largest there is)
    double mean = 0, minimum = 0, maximum = 0;
    /// Pixels sorted by error: up to here lie a quarter, half, three quarters of the sum of all
    /// errors. 0 for equal pictures.
    double first_quartile = 0, median = 0, third_quartile = 0;
};

/// Both encoded sRGB; limited to [0, 1], NaN counts as 0. Symmetric but for rounding; equal
/// pictures give exactly 0. Same bytes at any thread count.
/// Throws Error{bad_input} if the sizes differ or are 0, Error{usage} for pixels per degree out of
/// their range. Cost: ~40 ns a pixel and core (bench/flip_bench.cpp); memory: the map.
FlipResult flip(ImageView<const SrgbF> reference, ImageView<const SrgbF> test,
                const FlipOptions& options = {});

/// The map as FLIP shows it: "magma" [Magma], black for 0, almost white for 1.
Image<SrgbU8> flip_picture(const Image<float>& map);

}  // namespace verdigris
