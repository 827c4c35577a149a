// SPDX-License-Identifier: MIT
// Pictures of another size. In encoded sRGB on purpose: the forecast lives there, so the average of
// a trajectory is the trajectory of the averages.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Width and height in whole pixels, both at least 1.
struct PictureSize {
    int width = 0, height = 0;
    bool operator==(const PictureSize&) const = default;
};
/// The extent that fits into `limit` x `limit` with the same aspect; not enlarged.
PictureSize fitted(PictureSize extent, int limit);

/// Smaller: exact area average. Larger: bicubic, clamped to [0, 1] (SrgbF only). Same: a copy.
Image<SrgbF> resampled(ImageView<const SrgbF> image, PictureSize extent);
/// Smaller: exact area average. Larger: bilinear. Same: a copy.
Image<float> resampled(ImageView<const float> image, PictureSize extent);

}  // namespace verdigris
