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

}  // namespace verdigris
