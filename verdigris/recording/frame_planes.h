// SPDX-License-Identifier: MIT
// A decoded frame as planes: pointers into the decoder's buffers where the layout allows it, else
// the same samples laid out anew. No value is ever changed. Internal (FFmpeg types).
#pragma once

#include <memory>

#include "verdigris/recording/frame_format.h"
#include "verdigris/recording/libav.h"

namespace verdigris {

struct FramePlanes {
    PlaneSet planes;
    std::shared_ptr<const void> owner;
};

/// `frame` must have a readable_layout() of `format`. Packed RGB of 3 x 8 or 3 x 16 bits is one
/// interleaved plane; all else is one plane per component: Y Cb Cr, R G B, or gray.
FramePlanes planes_of_frame(libav::FramePtr frame, const FrameFormat& format, bool mirrored);

}  // namespace verdigris
