// SPDX-License-Identifier: MIT
// A recording made of images in memory or of a function: for tests and for the simulator.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/recording/recording.h"

namespace verdigris {

/// `frame(i)` gives frame i (all of one size); `times` one entry per frame, seconds, increasing.
/// The samples are handed on as 8-bit RGB, like photographs.
Recording recording_from_function(int width, int height, std::vector<double> times,
                                  std::function<Image<SrgbU8>(int index)> frame,
                                  std::string name = "memory");

}  // namespace verdigris
