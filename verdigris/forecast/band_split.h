// SPDX-License-Identifier: MIT
// Fields over the specimen, split by how far they reach: what a Gaussian keeps, coarse to fine
// (internal).
#pragma once

#include <vector>

#include "verdigris/pixels/image.h"

namespace verdigris {

/// Values of one channel, row-major; 0 outside the mask.
using Field = std::vector<float>;

/// Standard deviations, in pixels, of the Gaussians that split fields of this size: powers of two
/// from a sixteenth of the longer side down to 1.
std::vector<int> band_sigmas(int width, int height);

/// Means under a Gaussian, of what lies inside a mask [Knutsson1993: normalized convolution]. From
/// sigma 4 on, of cells of sigma / 2 pixels and interpolated: O(pixels) at any sigma. Truncated at
/// 3 sigma. Same bytes at any number of threads.
class MaskedGaussian {
  public:
    MaskedGaussian(const Mask& inside, int sigma);
    /// `field` is 0 outside. `out` is resized; 0 outside.
    void mean(const Field& field, Field& out) const;
    /// The same in two steps: what is kept of a field, then one row of what it stands for, `width`
    /// values. Rows are linear in cells.
    void cells(const Field& field, Field& cells) const;
    void row(const Field& cells, int y, float* out) const;

  private:
    struct Between {
        int from, to;
        float share;
    };
    Between between(int at, int count) const;
    void sums(const Field& field, Field& cells) const;
    void blur(Field& cells) const;

    const Mask& inside_;
    int width_, height_, cell_, columns_, rows_;
    std::vector<float> taps_;  ///< center first
    Field weight_;             ///< blurred mask, in cells
    std::vector<Between> across_;
};

}  // namespace verdigris
