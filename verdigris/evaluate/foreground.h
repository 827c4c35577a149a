// SPDX-License-Identifier: MIT
// Which pixels of a window change, judged from the truth alone: no forecast has a say in where it
// is judged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/evaluate/protocol.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// 1 or 0 per pixel, row-major: sums take it as a weight.
struct PixelWeights {
    std::vector<float> weight;
    std::int64_t count = 0;  ///< pixels of weight 1
};
/// All pixels where `mask` is empty.
PixelWeights weights_of(const Mask& mask, int width, int height);

/// What counts as a change: the protocol's tau, else from the noise of one sample, at least its
/// floor.
double foreground_threshold(const EvaluationProtocol& protocol, double sigma);

/// The context's canvas: per pixel and channel the median of its frames; of an even number the mean
/// of the two middle values. O(n^2) per pixel, vectorized; `scratch` keeps its memory between
/// calls.
void canvas_of(std::span<const Image<SrgbF>> context, Image<SrgbF>& canvas,
               std::vector<float>& scratch);

/// A pixel is foreground of horizon k if the mean over channels of |truth_k - canvas| exceeds tau
/// (docs/PROTOCOL.md). With the union rule one mask, of any horizon; else one per horizon. Pixels
/// outside `area` never are.
void foreground_of(std::span<const Image<SrgbF>* const> truths, const Image<SrgbF>& canvas,
                   double tau, MaskRule rule, const PixelWeights& area,
                   std::vector<PixelWeights>& foreground);

}  // namespace verdigris
