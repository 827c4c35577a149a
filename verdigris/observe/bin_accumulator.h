// SPDX-License-Identifier: MIT
// One bin of the time axis: frames go in, a trimmed mean of the coded samples comes out. Works on
// the planes as coded; color is made afterwards, once per bin.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "verdigris/pixels/image.h"
#include "verdigris/recording/frame_format.h"
#include "verdigris/recording/recording.h"

namespace verdigris {

/// How the frames of a bin are trimmed. Up to `largest` frames are trimmed one by one; of more,
/// consecutive frames are first averaged into at most `largest` groups of (nearly) equal size, so
/// that memory stays bounded. Of n values floor(trim * n) are dropped at each end.
struct TrimRule {
    double trim = 0.1;
    int largest() const;            ///< 80 for a trim of 0.1
    int dropped(int values) const;  ///< floor(trim * values), at most kMaxTrim
};

/// The plane samples inside `coded` (luma units, from coded_rect).
Rect plane_rect(const FrameFormat& format, int plane, Rect coded);

class BinAccumulator {
  public:
    /// `coded`: the luma samples that matter. Nothing else of a frame is read.
    BinAccumulator(const FrameFormat& format, Rect coded, double trim);
    ~BinAccumulator();
    BinAccumulator(BinAccumulator&&) noexcept;
    BinAccumulator& operator=(BinAccumulator&&) noexcept;

    /// Starts a bin that will get `expected` frames. Fewer may come (lost ones), never more.
    void begin(int expected);
    /// Frames are held a few at a time and read together, so that the state passes through memory
    /// once per batch. Throws Error{bad_input} if a frame has other planes than the format says.
    void add(const Frame& frame);
    /// Frames added since begin().
    int count() const;
    /// Trimmed means as f32 planes in code values, valid until the next begin(). Needs count() > 0.
    PlaneSet means();
    /// The means of integer samples as 16-bit codes with 16 - format.bits bits behind the point,
    /// plane after plane as in SampleLayout. Needs count() > 0.
    void codes(std::uint16_t* out);

    struct State;

  private:
    std::unique_ptr<State> state_;
};

}  // namespace verdigris
