// SPDX-License-Identifier: MIT
// Decoded planes -> encoded sRGB in [0, 1], in float: matrix, range, chroma siting, transfer,
// primaries and rotation honored. RGB(200,100,50) coded as BT.709 comes back within 1.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/recording/frame_format.h"

namespace verdigris {

/// The part of the shown frame inside `crop` (shown coordinates, after rotation).
/// `planes` may hold f32 means of coded samples (in code-value units, i.e. 0..255 for 8 bit):
/// the bins of observe/. Chroma is interpolated linearly at its true siting. Values are clamped
/// to [0, 1]. O(pixels), rows in parallel.
Image<SrgbF> srgb_from_planes(const PlaneSet& planes, const FrameFormat& format, Rect crop);

/// The rectangle of coded (unrotated) luma samples that `shown` covers, widened to whole chroma
/// samples plus one sample of support on each side, clipped to the frame.
Rect coded_rect(const FrameFormat& format, Rect shown);

/// As srgb_from_planes for planes that hold only the coded samples inside `coded` (luma units,
/// as returned by coded_rect); `crop` is in shown coordinates of the whole frame.
Image<SrgbF> srgb_from_part(const PlaneSet& part, Rect coded, const FrameFormat& format, Rect crop);

}  // namespace verdigris
