// SPDX-License-Identifier: MIT
// The paper's structured network: a scalar state per pixel that only grows, its pace driven by a
// global coordinate, its distribution by a static susceptibility; a decoder turns state into color
// (internal). Layers are ours within the paper's description and its size, 0.17 M.
#pragma once

#include <torch/nn/functional/activation.h>

#include <vector>

#include "verdigris/learn/network_module.h"

namespace verdigris {

/// delta + spread * Laplacian(delta) for a [B, 1, H, W] field: five points, replicated borders.
/// With 0 <= spread <= 1/4 a convex combination of neighbors: non-negative for non-negative input,
/// never above its maximum, and with the same sum.
torch::Tensor spread_increment(const torch::Tensor& delta, const torch::Tensor& spread);

class PatinaNet final : public NetworkModule {
  public:
    explicit PatinaNet(const NetworkConfig& config);

    torch::Tensor predict(const torch::Tensor& context, const std::vector<int>& horizons) override;

    /// What the network believes of a context, before any step.
    struct Encoded {
        torch::Tensor canvas;          ///< [B, 3, H, W], temporal median
        torch::Tensor susceptibility;  ///< [B, 1, H, W] in (0, 1), static
        torch::Tensor state;           ///< [B, 1, H, W] in (0, 1)
        torch::Tensor features;        ///< [B, 8, H, W], static
        torch::Tensor global;          ///< [B, 64]
    };
    Encoded encode(const torch::Tensor& context);
    /// The state one unit later: in [state, 1], nowhere smaller.
    torch::Tensor step(const Encoded& encoded, const torch::Tensor& state);
    /// How fast the specimen ages on average, [B, 1], at the global coordinate (the state's mean).
    torch::Tensor pace(const Encoded& encoded, const torch::Tensor& state);
    /// The spread D = sigmoid(d) / 4, in (0, 1/4): its bound of stability.
    torch::Tensor spread() const { return 0.25 * torch::sigmoid(spread_logit_); }

  private:
    torch::Tensor decode_fixed(const Encoded& encoded);
    torch::Tensor decode(const torch::Tensor& fixed, const torch::Tensor& state);

    torch::nn::Conv2d a0_, a1_, a2_, a3_, y1_, y0_;
    torch::nn::GroupNorm n0_, n1_, n2_, n3_, m1_, m0_;
    torch::nn::Conv2d susceptibility_, state_, features_;
    torch::nn::Linear global_, pace1_, pace2_;
    torch::nn::Conv2d decode1_, decode2_, decode3_;
    torch::Tensor spread_logit_;
};

}  // namespace verdigris
