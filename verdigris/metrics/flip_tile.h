// SPDX-License-Identifier: MIT
// The errors of one tile, every stage fused: rows go through it once (internal).
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/metrics/flip_filters.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Writes `map` inside `tile`; what it holds does not depend on how the image is cut into tiles.
void flip_tile(ImageView<const SrgbF> reference, ImageView<const SrgbF> test,
               const FlipFilters& filters, Rect tile, Image<float>& map);

}  // namespace verdigris
