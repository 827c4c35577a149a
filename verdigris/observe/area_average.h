// SPDX-License-Identifier: MIT
// Resampling by area: an output pixel is the mean of the source area it covers, exactly, so that
// noise averages down and nothing aliases.
#pragma once

#include <utility>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// From a source of `source_width` x `source_height` to `width` x `height`. Where the output is
/// larger than the source, pixels are interpolated linearly instead.
struct Resampling {
    int source_width = 0, source_height = 0, width = 0, height = 0;
    bool identity() const { return source_width == width && source_height == height; }

    /// [first, last) source rows that the output rows [begin, end) need.
    std::pair<int, int> source_rows(int begin, int end) const;
};

/// The output rows [begin, end). `part` holds the source rows from `part_y` on, at least those
/// that source_rows() names. The result does not depend on how the output is cut into parts.
Image<SrgbF> resample_rows(const Image<SrgbF>& part, int part_y, const Resampling& resampling,
                           int begin, int end);

/// The whole image. A mask is averaged and cut at one half.
Image<SrgbF> resample(const Image<SrgbF>& image, int width, int height);
Mask resample(const Mask& mask, int width, int height);

/// The size with a long side of `side` that keeps the aspect.
std::pair<int, int> size_with_long_side(int width, int height, int side);

}  // namespace verdigris
