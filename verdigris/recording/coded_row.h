// SPDX-License-Identifier: MIT
// A stretch of one row of coded samples -> encoded sRGB: the arithmetic behind to_srgb.h.
#pragma once

#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/recording/frame_format.h"

namespace verdigris {

/// Converts stretches of rows of a part of a frame. What comes out of a sample depends on its
/// place in the frame only, never on where the part or the stretch begins: the same samples give
/// the same bits. Not for several threads at once (it keeps scratch rows).
class CodedRow {
  public:
    /// `part` holds the samples inside `coded`; both outlive this object.
    CodedRow(const PlaneSet& part, Rect coded, const FrameFormat& format);
    /// Writes `n` pixels from luma sample (x, y), frame coordinates, which must lie in `coded`.
    void read(int x, int y, int n, SrgbF* out);

  private:
    void read_yuv(int x, int y, int n, SrgbF* out);
    void read_rgb(int x, int y, int n, SrgbF* out);
    void read_gray(int x, int y, int n, SrgbF* out);
    void read_chroma(const Plane& plane, int x, int y, int n, float* out);

    const PlaneSet& part_;
    Rect coded_;
    const FrameFormat& format_;
    float offset_ = 0, gain_ = 1;                // of luma, gray and RGB samples
    float chroma_offset_ = 0, chroma_gain_ = 1;  // of Cb and Cr
    float red_cr_ = 0, green_cb_ = 0, green_cr_ = 0, blue_cb_ = 0;
    std::vector<float> luma_, cb_, cr_, above_, below_;
};

}  // namespace verdigris
