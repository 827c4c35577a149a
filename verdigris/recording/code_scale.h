// SPDX-License-Identifier: MIT
// What the numbers in a frame's planes stand for: range, bits and matrix of [BT601], [BT709] and
// [BT2020], for any number of bits.
#pragma once

#include "verdigris/recording/frame_format.h"

namespace verdigris {

struct CodeScale {
    explicit CodeScale(const FrameFormat& format);

    double offset = 0, gain = 1;                ///< of luma, gray and RGB codes
    double chroma_offset = 0, chroma_gain = 1;  ///< of Cb and Cr codes
    /// R = Y + red_cr Cr, G = Y + green_cb Cb + green_cr Cr, B = Y + blue_cb Cb.
    double red_cr = 0, green_cb = 0, green_cr = 0, blue_cb = 0;

    double luma(double code) const { return (code - offset) * gain; }  ///< 0 black, 1 white
    double chroma(double code) const { return (code - chroma_offset) * chroma_gain; }  ///< +-1/2
};

}  // namespace verdigris
