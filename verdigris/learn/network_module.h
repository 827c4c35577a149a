// SPDX-License-Identifier: MIT
// What the four networks have in common, as libtorch sees them (internal).
#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "verdigris/learn/learn.h"

namespace verdigris {

/// Every network forecasts a change of the last observed frame: x_last + 0.1 f(k), f starting at 0.
inline constexpr double kResidualScale = 0.1;

/// Frames in, frames out. Encoded sRGB, float32; what comes out is not limited to [0, 1].
class NetworkModule : public torch::nn::Module {
  public:
    /// context [B, n, 3, H, W], n frames one unit apart, oldest first. horizons: whole units after
    /// the last frame, increasing, from 1. Returns [B, horizons, 3, H, W]. H and W as configured,
    /// or any multiple of 8 where the network allows it.
    virtual torch::Tensor predict(const torch::Tensor& context,
                                  const std::vector<int>& horizons) = 0;
};

std::shared_ptr<NetworkModule> make_patinanet(const NetworkConfig& config);
std::shared_ptr<NetworkModule> make_convlstm(const NetworkConfig& config);
std::shared_ptr<NetworkModule> make_predformer(const NetworkConfig& config);
std::shared_ptr<NetworkModule> make_horizonnet(const NetworkConfig& config);

/// Freshly initialized from torch's global generator.
std::shared_ptr<NetworkModule> make_module(const NetworkConfig& config);

/// k x k convolution with as much zero padding as keeps the size (halves it with stride 2).
torch::nn::Conv2d conv(int in, int out, int kernel, int stride = 1);
/// Eight groups, throughout.
torch::nn::GroupNorm group_norm(int channels);
/// Bilinear, twice the size, corners not aligned.
torch::Tensor twice_as_large(const torch::Tensor& x);
/// Of [B, n, ...] over n, per pixel and channel; the mean of the two middle ones where n is even
/// (torch::median takes the lower).
torch::Tensor median_frame(const torch::Tensor& frames);
/// So that step 0 of training is persistence.
void start_at_zero(const torch::nn::Conv2d& layer);
void start_at_zero(const torch::nn::Linear& layer);

}  // namespace verdigris
