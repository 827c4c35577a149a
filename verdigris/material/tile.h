// SPDX-License-Identifier: MIT
// The fused kernel of stage 3 on one tile of the image (internal).
#pragma once

#include <vector>

#include "verdigris/forecast/trajectory_row.h"
#include "verdigris/material/material.h"

namespace verdigris {

/// Everything a tile needs; shared by all tiles of one call.
struct TileJob {
    const MaterialRecipe* recipe = nullptr;
    const Trajectory* trajectory = nullptr;  ///< or, if null:
    ImageView<const SrgbF> frame;
    TrajectoryTime time;
    std::vector<float> height_taps, micro_taps;  ///< of gaussian_taps
    int width = 0, height = 0;
    Material* out = nullptr;
};

/// Rows [rect.y, ...) and columns [rect.x, ...) of all maps. Every pixel is computed from the same
/// numbers in the same order whatever the tile, so tiles of any cut fit together to the bit.
void materialize_tile(const TileJob& job, Rect rect);

/// Columns of a tile: what the row buffers of one thread are sized for. A multiple of any vector.
inline constexpr int kTileColumns = 2048;

}  // namespace verdigris
