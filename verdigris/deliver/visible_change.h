// SPDX-License-Identifier: MIT
// How much each pixel changes until a horizon, and up to where a scale of colors shows it.
#pragma once

#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// mean_c |frame - base|, the paper's change signal; 1 is full scale.
Image<float> change_between(const Image<SrgbF>& base, const Image<SrgbF>& frame);

/// Mean over `where` (empty: all), 0 if it has no pixel. Summed in double, row by row.
double mean_inside(const Image<float>& map, const Mask& where);

/// Rounded up to 1, 2 or 5 times a power of ten, between 0.01 (so noise does not blaze) and 1.
double round_scale(double largest);

/// The end of the color scale for these maps: the 99.5th percentile of the one that changes most,
/// through round_scale().
double change_scale(const std::vector<Image<float>>& maps, const Mask& where);

}  // namespace verdigris
