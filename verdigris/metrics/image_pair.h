// SPDX-License-Identifier: MIT
// What every metric asks of its two pictures first (internal).
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Throws Error{bad_input} with a sentence naming both sizes if they differ or nothing is in them.
void check_pair(ImageView<const SrgbF> reference, ImageView<const SrgbF> test);

/// In [0, 1]; NaN is 0.
inline double limited(float v) {
    return v > 0 ? (v < 1 ? double(v) : 1.0) : 0.0;
}

}  // namespace verdigris
