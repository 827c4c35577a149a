// SPDX-License-Identifier: MIT
// Numbers as colors: for maps of change and of error.
#pragma once

#include <array>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Matplotlib's "magma" [Magma], through OpenCV's table: black first, almost white last.
const std::array<SrgbU8, 256>& magma_table();

/// 0 and below is black, `full` and above the lightest; NaN is black. `full` > 0.
Image<SrgbU8> magma(const Image<float>& map, double full);

}  // namespace verdigris
