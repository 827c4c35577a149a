// SPDX-License-Identifier: MIT
// From the light of a scene to a picture for a screen.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Khronos PBR Neutral [PbrNeutral]: base colors up to 0.76 keep hue and saturation, lighter ones
/// roll off to white and nothing clips. Negative light counts as 0; result in [0, 1], linear.
LinearF pbr_neutral(LinearF light);

/// exposure: stops, light is multiplied by 2^exposure first. Rounding is spread over neighbors by
/// a fixed pattern, +- half a code, because 8 bits band in dark ramps.
Image<SrgbU8> developed(const Image<LinearF>& light, double exposure = 0);

}  // namespace verdigris
