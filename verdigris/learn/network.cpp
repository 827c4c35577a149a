// SPDX-License-Identifier: MIT
#include <ATen/Parallel.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <malloc.h>
#include <torch/cuda.h>
#include <torch/utils.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/learn/learn.h"
#include "verdigris/learn/network_parts.h"

namespace verdigris {

std::string to_string(NetworkKind kind) {
    switch (kind) {
        case NetworkKind::patinanet:
            return "patinanet";
        case NetworkKind::convlstm:
            return "convlstm";
        case NetworkKind::predformer:
            return "predformer";
        case NetworkKind::horizonnet:
            return "horizonnet";
    }
    return "";
}

NetworkKind network_kind(std::string_view name) {
    std::string all;
    for (const NetworkKind kind : kNetworkKinds) {
        if (to_string(kind) == name) return kind;
        all += (all.empty() ? "" : ", ") + to_string(kind);
    }
    throw Error(ErrorCode::usage, fmt::format("there is no network '{}'; there are {}", name, all));
}

void check_network_config(const NetworkConfig& config) {
    if (config.context < 2 || config.context > 64) {
        throw Error(ErrorCode::usage, fmt::format("a network's context must be 2 to 64 frames, "
                                                  "not {}",
                                                  config.context));
    }
    if (config.size < 16 || config.size > 1024 || config.size % 8 != 0) {
        throw Error(ErrorCode::usage,
                    fmt::format("a network's frames must be 16 to 1024 pixels wide, a multiple "
                                "of 8, not {}",
                                config.size));
    }
}

Device device_from(std::string_view name) {
    if (name == "cpu") return Device::cpu;
    if (name != "cuda") {
        throw Error(ErrorCode::usage,
                    fmt::format("there is no device '{}'; there are cpu, cuda", name));
    }
    if (!torch::cuda::is_available()) {
        throw Error(ErrorCode::failed,
                    "CUDA was asked for, and this libtorch finds none; use --device cpu");
    }
    return Device::cuda;
}

torch::Device torch_device(Device device) {
    return device == Device::cuda ? torch::Device(torch::kCUDA) : torch::Device(torch::kCPU);
}

void use_cpu_for_networks(int threads) {
    const int count = std::max(threads, 1);
    at::set_num_threads(count);
    // An OpenBLAS built on pthreads has threads that libtorch does not know of, one per core, and
    // they wait by spinning: beside libtorch's own they made a step of patinanet 1.6 times as long.
    using Setter = void (*)(int);
    if (const auto set = reinterpret_cast<Setter>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
        set(count);
#ifdef __GLIBC__
    // A training step takes and frees gigabytes in blocks of megabytes. glibc would hand each back
    // to the system and have every page cleared anew: a third of the time.
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_TOP_PAD, 256 << 20);
#endif
}

Network::Network(const NetworkConfig& config, std::uint64_t seed)
    : parts_(std::make_unique<Parts>()) {
    check_network_config(config);
    torch::manual_seed(seed);
    parts_->config = config;
    parts_->module = make_module(config);
}
Network::~Network() = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;

const NetworkConfig& Network::config() const {
    return parts_->config;
}

std::int64_t Network::parameter_count() const {
    std::int64_t count = 0;
    for (const torch::Tensor& p : parts_->module->parameters()) count += p.numel();
    return count;
}

void Network::move_to(Device device) {
    if (device == Device::cuda) device_from("cuda");
    parts_->device = torch_device(device);
    parts_->module->to(parts_->device);
}

}  // namespace verdigris
