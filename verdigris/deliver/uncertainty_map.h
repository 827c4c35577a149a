// SPDX-License-Identifier: MIT
// Where on a specimen a forecast is less sure: the spread as a picture, at any size.
#pragma once

#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/deliver/delivery.h"
#include "verdigris/deliver/resample.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Mean of the channels of Spread::own at another size: variances, averaged as variances over what
/// moves. A pixel of which less than half moves is 0, held as it is in the full picture. It stays
/// the share of one recorded pixel; averaging pixels would make them surer than they are told to
/// be.
Image<float> own_share(const Spread& spread, PictureSize extent);

/// Half width of the nominal 80 % interval at a horizon, root mean square of the channels, encoded
/// sRGB in 0..1. `share`: from own_share(). 0 where that is 0, and up to a horizon of 0.
Image<float> half_width_map(const Spread& spread, const Image<float>& share, double horizon);

/// Where the colors of the map end, in codes of 255: what 99.5 % of the pixels that move stay
/// below at every delivered horizon, of which those beyond trusted_horizon() count up to four times
/// the first, rounded up to a number that is easily halved, 1 at least. 0 where nothing is stated.
/// One scale for all horizons, so that growth is seen.
double uncertainty_full_codes(const Delivery& delivery);

/// The colors of `magma` up to `full` (encoded sRGB in 0..1), and a neutral dark gray where
/// `share` is 0: what is held has no interval, which is not the same as a narrow one.
Image<SrgbU8> uncertainty_picture(const Image<float>& half_widths, const Image<float>& share,
                                  double full);
inline constexpr SrgbU8 kHeldGray{0x33, 0x36, 0x39};  ///< chosen: no color of "magma"

}  // namespace verdigris
