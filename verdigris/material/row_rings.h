// SPDX-License-Identifier: MIT
// The rows between two stages of the fused kernel: rings of row buffers, addressed by image row
// (internal).
#pragma once

#include <algorithm>
#include <cstddef>

#include "hwy/aligned_allocator.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// chosen: Gaussians up to sigma 10; wider ones are no micro-relief. Bounds the pointer arrays.
inline constexpr int kMaxRadius = 30;
/// glTF and most renderers treat perceptual roughness below this as a mirror they cannot sample.
inline constexpr float kMinRoughness = 0.04f;

/// A row pointer stands at the first column of the tile; `margin()` columns to its left and right
/// are valid too, and a vector more to the right.
class RowRings {
  public:
    void prepare(int height_radius, int micro_radius, int width) {
        reach_ = std::max(micro_radius, 1);                 // Sobel needs one
        margin_ = (reach_ + height_radius + 15) / 16 * 16;  // whole vectors on most machines
        stride_ = (width + 15) / 16 * 16 + 2 * margin_ + kVector;
        luma_rows_ = 2 * height_radius + 1;
        coverage_rows_ = height_radius + 1;
        height_rows_ = 2 * reach_ + 1;
        rough_rows_ = height_radius + reach_ + 1;
        const std::size_t needed =
            std::size_t(stride_) *
            std::size_t(luma_rows_ + coverage_rows_ + height_rows_ + rough_rows_ + 1);
        if (needed > capacity_) {
            buffer_ = hwy::AllocateAligned<float>(needed);
            capacity_ = needed;
        }
        std::fill_n(buffer_.get(), needed, 0.0f);  // margins are read in whole vectors
    }

    float* luma(int y) { return row(y % luma_rows_); }
    float* coverage(int y) { return row(luma_rows_ + y % coverage_rows_); }
    float* height(int y) { return row(luma_rows_ + coverage_rows_ + y % height_rows_); }
    float* rough(int y) {
        return row(luma_rows_ + coverage_rows_ + height_rows_ + y % rough_rows_);
    }
    /// Scratch for one row blurred along the columns.
    float* blurred() { return row(luma_rows_ + coverage_rows_ + height_rows_ + rough_rows_); }

    int reach() const { return reach_; }    ///< rows and columns of height around a pixel
    int margin() const { return margin_; }  ///< columns of color around the tile

    /// Where the tile touches the border of the image, repeats its outermost pixel outwards.
    void replicate(float* row, Rect rect, int image_width) const {
        if (rect.x == 0) std::fill(row - margin_, row, row[0]);
        const int left = image_width - rect.x;  // columns of the image from the tile's first on
        if (left < rect.width + margin_) {
            std::fill(row + left, row + rect.width + margin_, row[left - 1]);
        }
    }

  private:
    static constexpr int kVector = 64;  // floats; no vector is longer
    float* row(int index) { return buffer_.get() + std::ptrdiff_t(index) * stride_ + margin_; }

    hwy::AlignedFreeUniquePtr<float[]> buffer_;
    std::size_t capacity_ = 0;
    int reach_ = 1, margin_ = 0, stride_ = 0;
    int luma_rows_ = 1, coverage_rows_ = 1, height_rows_ = 1, rough_rows_ = 1;
};

}  // namespace verdigris
