// SPDX-License-Identifier: MIT
// libtorch's side of a Network (internal).
#pragma once

#include <torch/types.h>

#include <memory>
#include <mutex>

#include "verdigris/learn/learn.h"
#include "verdigris/learn/network_module.h"

namespace verdigris {

struct Network::Parts {
    NetworkConfig config;
    std::shared_ptr<NetworkModule> module;
    torch::Device device{torch::kCPU};
    std::mutex one_at_a_time;  ///< libtorch has threads of its own
};

torch::Device torch_device(Device device);

/// contexts [B, n, 3, h, w] of any size give [B, units, 3, h, w], on the CPU. The network sees them
/// reduced to its own square; what it forecasts to change is enlarged and added to the last frame.
/// One caller at a time; no gradients.
torch::Tensor forecast_frames(const Network& network, const torch::Tensor& contexts,
                              const std::vector<int>& units);

}  // namespace verdigris
