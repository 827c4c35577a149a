// SPDX-License-Identifier: MIT
// Structural similarity [Wang2004], on one scale and on five [Wang2003]: 1 for equal pictures.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// The window is 11 x 11 pixels, a Gaussian of sigma 1.5; only places where it fits are counted.
inline constexpr int kSsimSmallest = 11;
/// What is left after halving four times must still hold a window.
inline constexpr int kMsSsimSmallest = 161;

/// Mean over places of each of R, G and B of encoded sRGB, limited to [0, 1] (NaN counts as 0), and
/// over the three: K1 = 0.01, K2 = 0.03, data range 1, moments weighted without Bessel's
/// correction. In [-1, 1]; symmetric. Throws Error{bad_input} if the sizes differ or a side is
/// below kSsimSmallest. In double, ~0.1 us a pixel and core; memory: 16 bytes a pixel.
double ssim(ImageView<const SrgbF> reference, ImageView<const SrgbF> test);

/// On five scales, each the mean of 2 x 2 of the one before (an odd last row or column with
/// itself): contrast and structure of all, luminance of the last, to the powers of [Wang2003].
/// Channel by channel as ssim(); a scale of negative correlation counts as 0, whose power is
/// defined. In [0, 1]. Throws as ssim(), for a side below kMsSsimSmallest.
double ms_ssim(ImageView<const SrgbF> reference, ImageView<const SrgbF> test);

}  // namespace verdigris
