// SPDX-License-Identifier: MIT
// How far a forecast frame is from the truth, over the pixels that change and over the specimen.
#pragma once

#include <array>
#include <span>

#include "verdigris/color/pixel_types.h"
#include "verdigris/evaluate/foreground.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Encoded sRGB throughout, as the paper.
struct MaskedError {
    double foreground = 0;  ///< mean over foreground pixels and channels of (forecast - truth)^2
    double specimen = 0;    ///< the same over the whole specimen
    double absolute = 0;    ///< mean over the specimen and channels of |forecast - truth|
    std::array<double, 3> bias{};  ///< mean over the specimen of forecast - truth, per channel
};

/// NaN over no pixel. Images and weights of one size. One pass, SIMD, ~1 ns a pixel; blocks of
/// float sums are added in double.
MaskedError masked_error(const Image<SrgbF>& forecast, const Image<SrgbF>& truth,
                         const PixelWeights& foreground, const PixelWeights& specimen);

}  // namespace verdigris
