// SPDX-License-Identifier: MIT
// Windows of a recording as batches of tensors, and the loss on them (internal).
#pragma once

#include <torch/types.h>

#include <vector>

#include "verdigris/evaluate/protocol.h"
#include "verdigris/evaluate/windows.h"
#include "verdigris/observe/observe.h"
#include "verdigris/progress.h"

namespace verdigris {

class TrainingSet {
  public:
    /// The samples of `range` as floats, stretched to a square of learned_size(), and windows that
    /// lie inside it. Throws Error{bad_input} if it leaves none.
    TrainingSet(const EvaluationProtocol& protocol, const Observation& observation,
                SampleRange range, const Progress& progress);

    int count() const { return count_; }
    int size() const { return int(samples_.size(3)); }
    /// At most `most` of them, evenly spaced; 0: all.
    std::vector<int> chosen(int most) const;
    /// [B, n + K, 3, H, W].
    torch::Tensor windows(const std::vector<int>& indices) const;
    /// Foreground threshold, as an evaluation of this recording would take it.
    double tau() const { return tau_; }

  private:
    int stride_, frames_, count_;
    double tau_;
    torch::Tensor samples_;
};

/// The side of the square in which a network sees samples of this size: the longer side, up to the
/// next multiple of 8.
int learned_size(int width, int height);

/// Where a window changes, by the protocol's union rule: [B, 1, 1, H, W], 0 or 1. windows
/// [B, n + K, 3, H, W]; tau [B].
torch::Tensor foreground_mask(const torch::Tensor& windows, int context, const torch::Tensor& tau);

/// Sums of a batch's squared errors over channels, seen two ways. predicted and truth
/// [B, h, 3, H, W]; mask as above; windows whose mask has fewer than `least` pixels have no
/// foreground part.
struct WindowErrors {
    torch::Tensor foreground;  ///< [B, h], mean over mask and channels; 0 where there is no part
    torch::Tensor all;         ///< [B, h], mean over pixels and channels
    torch::Tensor counted;     ///< [B], 1 where there is a foreground part
};
WindowErrors window_errors_of(const torch::Tensor& predicted, const torch::Tensor& truth,
                              const torch::Tensor& mask, int least);

/// Mean over windows that count and over horizons, weighted: sum_h w_h e_h with sum w = 1.
/// `scale` is persistence's error.
torch::Tensor window_loss(const WindowErrors& errors, const torch::Tensor& horizon_weights,
                          double scale);

}  // namespace verdigris
