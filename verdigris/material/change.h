// SPDX-License-Identifier: MIT
// The change map of a frame against the canvas (internal).
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// mean_c |frame_c - canvas_c| per pixel. Both of one size.
Image<float> change_map(const Image<SrgbF>& frame, const Image<SrgbF>& canvas);

}  // namespace verdigris
