// SPDX-License-Identifier: MIT
// Temporal noise from second differences, streamed: r_t = x_{t+1} - 2 x_t + x_{t-1} removes aging
// that is linear over three samples; sigma = 1.4826 median|r| / sqrt(6).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/observe/observe.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// A value is saturated at or above this, or if all channels are at or below kBlack.
/// chosen: 250 of 255, where photographs of the flash streak flatten; 1 of 255.
inline constexpr float kSaturated = 0.98f, kBlack = 0.004f;
inline bool is_clipped(SrgbF c) {
    return c.r >= kSaturated || c.g >= kSaturated || c.b >= kSaturated ||
           (c.r <= kBlack && c.g <= kBlack && c.b <= kBlack);
}

/// Counts |r| at 16-bit resolution in cells of the image, so that the specimen may be known later
/// than the samples. Memory: a fixed histogram per cell, three samples of the probe.
class NoiseMeter {
  public:
    /// Probes of width x height pixels: the same pixels of every sample, as one image.
    NoiseMeter(int width, int height);

    /// The probe of sample `index`. Triples of consecutive indices count; a gap starts anew.
    void add(int index, const Image<SrgbF>& probe);

    /// sigma over the pixels where `inside` (of the probe's size; empty: all) is set: exactly if
    /// it was given to only_inside() before, else over the cells that lie mostly inside.
    /// Nothing if no triple was seen there.
    std::optional<double> sigma(const Mask& inside = {}) const;
    /// Before the first add(): count these pixels only.
    void only_inside(Mask inside) { inside_ = std::move(inside); }

  private:
    static constexpr int kCellsAcross = 16, kCellsDown = 8;
    static constexpr int kLevels = 16384;  ///< |r| up to 0.25; more counts as 0.25
    int cell(int x, int y) const;
    void count_row(int y, const SrgbU16* oldest, const SrgbU16* middle, const SrgbU16* newest);

    int width_, height_;
    Mask inside_;
    std::array<Image<SrgbU16>, 3> last_;  ///< by index modulo 3
    int last_index_ = -1, run_ = 0;
    std::vector<std::vector<std::uint32_t>> counts_;  ///< per cell, empty until needed
};

/// The noise of one picture when there is no time to measure it in: the median absolute response
/// to a 3 x 3 Laplacian-like mask that ignores slopes [Immerkaer1996]. Texture counts as noise, so
/// it overestimates.
double spatial_sigma(const Image<SrgbF>& image, const Mask& inside);

/// tau = given, or 2.40 sigma, at least 5e-4.
Noise noise_from(double sigma, std::optional<double> tau);

}  // namespace verdigris
