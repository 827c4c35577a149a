// SPDX-License-Identifier: MIT
// One draw per window, applied to all of its frames alike: nothing may move or flash within a
// window that did not before (internal).
#pragma once

#include <torch/types.h>

#include <cstdint>
#include <vector>

namespace verdigris {

struct WindowAugmentation {
    bool flip = false;                ///< left for right
    bool resample = false;            ///< else pixels stay where they are, and their noise as it is
    double shift_x = 0, shift_y = 0;  ///< pixels, within 4
    double zoom = 1;                  ///< part of the frame that is seen, 0.85 .. 1
    double place_x = 0, place_y = 0;  ///< where in the frame that part lies, -1 .. 1
    double gain = 1, bias = 0;        ///< within 6 %, of all channels alike
};

/// The draw of item `item` of step `step`: a function of these alone, so that an interrupted run
/// goes on with the same draws.
WindowAugmentation draw_augmentation(std::uint64_t seed, std::int64_t step, int item);

/// windows [B, frames, 3, H, W], one augmentation each. Bilinear, reflected at the borders, not
/// clamped: a clipped color is another change over time.
torch::Tensor augmented(const torch::Tensor& windows,
                        const std::vector<WindowAugmentation>& augmentations);

/// Order of `count` windows in an epoch: a permutation, of seed and epoch alone.
std::vector<int> shuffled(int count, std::uint64_t seed, int epoch);

}  // namespace verdigris
