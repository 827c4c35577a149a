// SPDX-License-Identifier: MIT
// Errors of pixels taken one by one: mean squared error, PSNR and CIEDE2000.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Mean over pixels and channels of the squared difference of encoded values, limited to [0, 1]
/// (NaN counts as 0). Throws Error{bad_input} if the sizes differ or are 0. ~2 ns a pixel.
double mean_squared_error(ImageView<const SrgbF> reference, ImageView<const SrgbF> test);

/// -10 log10(mse) dB for a peak of 1; infinity for equal pictures.
double psnr_of(double mean_squared_error);

struct ColorDifference {
    double mean = 0;          ///< CIEDE2000; 1 is about the smallest difference seen side by side
    double percentile95 = 0;  ///< the smallest that 95 % of the pixels do not exceed
};

/// CIEDE2000 of every pixel, limited to [0, 1] as above. Throws as mean_squared_error.
/// ~0.3 us a pixel and core; memory: 4 bytes a pixel.
ColorDifference color_difference(ImageView<const SrgbF> reference, ImageView<const SrgbF> test);

}  // namespace verdigris
