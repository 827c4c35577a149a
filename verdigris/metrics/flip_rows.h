// SPDX-License-Identifier: MIT
// The rows between the stages of the fused kernel (internal).
#pragma once

#include <algorithm>
#include <cstddef>

#include "hwy/aligned_allocator.h"

namespace verdigris {

/// `above[i]` and `below[i]` are the rows i away from a row of one channel; 0 is the row itself.
struct RowsAround {
    const float* const* above = nullptr;
    const float* const* below = nullptr;
};

/// One picture's rows of a tile: converted to opponent colors, a ring of as many as the filters
/// see; and of the current row what is filtered along the columns. A row pointer stands at the
/// first column of the tile; margin() columns to its left and right are valid too, and a vector
/// more.
class FlipRows {
  public:
    enum Channel { luma, red_green, blue_yellow, kChannels };
    enum Filtered { blurred_luma, blurred_red_green, wide, narrow, smooth, edge, point, kFiltered };
    static constexpr int kVector = 64;  ///< floats; no vector is longer

    FlipRows(int width, int reach)
        : margin_((reach + 15) / 16 * 16),
          stride_((width + 15) / 16 * 16 + 2 * margin_ + kVector),
          ring_(2 * reach + 1),
          buffer_(hwy::AllocateAligned<float>(std::size_t(stride_) *
                                              std::size_t(kChannels * ring_ + kFiltered))) {
        // Vectors look past the margins: at anything, but never at memory that nobody wrote.
        std::fill_n(buffer_.get(),
                    std::size_t(stride_) * std::size_t(kChannels * ring_ + kFiltered), 0.0f);
    }

    int margin() const { return margin_; }
    float* converted(Channel channel, int y) { return row(channel * ring_ + y % ring_); }
    float* filtered(Filtered which) { return row(kChannels * ring_ + which); }

  private:
    float* row(int index) { return buffer_.get() + std::ptrdiff_t(index) * stride_ + margin_; }

    int margin_, stride_, ring_;
    hwy::AlignedFreeUniquePtr<float[]> buffer_;
};

}  // namespace verdigris
