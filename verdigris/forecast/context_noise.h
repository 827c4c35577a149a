// SPDX-License-Identifier: MIT
// The noise of one frame, read off the context itself (internal).
#pragma once

#include <span>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Standard deviation per pixel and channel: median over pixels of the residual variance about
/// each pixel's own straight line, after each frame's mean is taken out (an exposure step is not
/// noise). `fallback` for fewer than 4 frames, where a line leaves too little to judge.
double context_noise(std::span<const Image<SrgbF>> frames, const Mask& where, double fallback);

}  // namespace verdigris
