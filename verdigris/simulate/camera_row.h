// SPDX-License-Identifier: MIT
// One row of light to one row of noisy light, as a SIMD kernel takes it (internal).
#pragma once

#include <cstddef>
#include <cstdint>

namespace verdigris {

struct CameraRow {
    const float* before = nullptr;  ///< linear light, interleaved r, g, b
    const float* after = nullptr;
    const float* gain = nullptr;   ///< per sample
    const float* noise = nullptr;  ///< standard normal, per sample
    std::size_t samples = 0;
    float mix = 0;             ///< light is before + mix (after - before)
    float band = 1;            ///< multiplies all gains
    float shot = 0, read = 0;  ///< variance is shot v + read
};

/// v = light gain band; v + sqrt(shot v + read) noise, clipped to [0, 1]. Same bits on every
/// target.
void expose_row(const CameraRow& row, float* out);
/// The same as the nearest of `levels` equal steps, 0 to levels - 1.
void expose_row_levels(const CameraRow& row, int levels, std::int32_t* out);

}  // namespace verdigris
