// SPDX-License-Identifier: MIT
// The part of a picture that shows the specimen and nothing else.
#pragma once

#include "verdigris/pixels/image.h"

namespace verdigris {

/// The largest upright rectangle in which at least 98 % of each of the at most 128 x 128 cells of
/// the picture is not 0 in `mask`, less a rim of 1 % of the picture on the sides where the picture
/// goes on; everything where the mask is empty or has no such cell.
/// chosen, 98 %: a speck of dust must not halve the specimen. O(pixels).
Rect largest_rectangle(const Mask& mask, int width, int height);

}  // namespace verdigris
