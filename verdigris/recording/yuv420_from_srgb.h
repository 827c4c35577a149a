// SPDX-License-Identifier: MIT
// Encoded sRGB -> 8-bit Y'CbCr 4:2:0 as H.264 is usually fed: BT.709 matrix, limited range, chroma
// left-sited. Internal.
//
// Own code: libswscale, asked for the same siting and all the accuracy it has, takes as long on one
// core, is up to 0.85 of a code off in chroma (bench/recording_writer_bench.cpp), and its bytes
// would be those of its version.
#pragma once

#include <cstddef>
#include <cstdint>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Where to write. Y has the size of the picture, Cb and Cr half of it. Strides in bytes.
struct Yuv420Planes {
    std::uint8_t *y = nullptr, *cb = nullptr, *cr = nullptr;
    std::ptrdiff_t y_stride = 0, chroma_stride = 0;
};

/// `image` has an even width and an even height. Each code is the nearest to the exact value (to
/// 0.012 of a code); grays have chroma 128 exactly. A chroma sample is the mean of two rows,
/// weighted 1 2 1 across around its own column [BT709]; beyond the edge the edge goes on.
/// O(pixels), rows in parallel, about 2 ns per pixel on one core.
void yuv420_from_srgb(ImageView<const SrgbU8> image, const Yuv420Planes& out);

}  // namespace verdigris
