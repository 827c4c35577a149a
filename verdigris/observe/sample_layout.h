// SPDX-License-Identifier: MIT
// How samples are coded where they are stored: 16-bit codes, either of encoded sRGB or of the
// recording's own planes. A 4:2:0 sample in its own planes is half as large, and its color is made
// only when somebody looks at it: of a recording, a forecast looks at the last ten.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/recording/frame_format.h"

namespace verdigris {

/// One sample: its planes one after the other, each row-major without gaps.
using SampleCodes = std::vector<std::uint16_t>;

struct SampleLayout {
    FrameFormat format;  ///< of u16 codes
    Rect coded;          ///< the luma samples that are stored
    Rect shown;          ///< the part of the shown frame that is the sample

    bool is_rgb() const { return format.model == PixelModel::rgb; }
    int width() const { return shown.width; }
    int height() const { return shown.height; }
    std::size_t codes() const;  ///< per sample
    /// `codes` outlives the result.
    PlaneSet planes(const std::uint16_t* codes) const;
    /// Throws Error{bad_input} if `shown` does not follow from `coded`, or sizes make no sense.
    void check() const;
};

/// Encoded sRGB, one 3-channel plane.
SampleLayout rgb_layout(int width, int height);
/// The planes of `format` behind the part `shown` of its frames, with as many bits behind the
/// point as fit. Needs a YUV format of integers.
SampleLayout plane_layout(const FrameFormat& format, Rect shown);

/// Rows [begin, end) of a sample as encoded sRGB in [0, 1]. O(pixels), rows in parallel.
Image<SrgbF> rows_of_sample(const SampleLayout& layout, const std::uint16_t* codes, int begin,
                            int end);
/// The codes of rgb_layout(). `out` has their number already. Rows in parallel.
void pack_rgb(const Image<SrgbF>& image, SampleCodes& out);

}  // namespace verdigris
