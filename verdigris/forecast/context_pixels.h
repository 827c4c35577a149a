// SPDX-License-Identifier: MIT
// Which pixels of a context count, and which may move (internal).
#pragma once

#include <cstdint>
#include <vector>

#include "verdigris/forecast/affine.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// Throws Error{usage}: no frame, frames or masks of different sizes, an empty frame.
void check_context(const Context& context);

/// Pixels that steer a fit: all or the specimen, never the clipped ones. 255 or 0, full size.
Mask fit_mask(const Context& context, FitPixels pixels);
/// Pixels that are forecast: the specimen without the clipped ones. 255 or 0, full size.
Mask moving_mask(const Context& context);
/// What may move; the backdrop is held where it is known, whatever else is to be forecast.
Mask specimen_of(const Context& context);
std::int64_t count_inside(const Mask& mask);

/// Raster indices, increasing, of at most `limit` pixels inside the mask: what a statistic is taken
/// on where every pixel would cost much and say little more. The pixels inside are cut into `limit`
/// runs of one length and each run gives one, by a fixed sequence without a pattern: every pixel is
/// as likely as any other, also where a step through the rows would meet the same columns again and
/// again. Same mask, same indices.
std::vector<std::size_t> sample_inside(const Mask& mask, std::int64_t limit);

}  // namespace verdigris
