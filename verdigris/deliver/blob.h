// SPDX-License-Identifier: MIT
// Arrays of numbers inside the viewer's JSON: 16-bit, delta-coded, zlib, base64. The format is
// docs/VIEWER_DATA.md.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// A value is offset + scale * u16.
struct Quantization {
    double scale = 0, offset = 0;
};

struct Blob {
    int channels = 1;
    Quantization quantization;
    std::string data;  ///< base64 of zlib of left-delta u16, little-endian
};

/// Steps from the smallest value to the largest, so that a value returns within half a step.
/// Values that are not finite count as 0.
Blob encode_blob(ImageView<const SrgbF> image);
Blob encode_blob(ImageView<const float> image);
/// With given steps, where particular values must return exactly; values beyond are clipped.
Blob encode_blob(ImageView<const float> image, Quantization quantization);

/// The smallest step that spans the values. Exposed for images that must share it.
Quantization quantization_of(std::span<const float> values);

}  // namespace verdigris
