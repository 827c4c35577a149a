// SPDX-License-Identifier: MIT
#include "verdigris/learn/network_module.h"

#include <torch/nn/functional/upsampling.h>
#include <torch/nn/init.h>

namespace verdigris {

std::shared_ptr<NetworkModule> make_module(const NetworkConfig& config) {
    switch (config.kind) {
        case NetworkKind::patinanet:
            return make_patinanet(config);
        case NetworkKind::convlstm:
            return make_convlstm(config);
        case NetworkKind::predformer:
            return make_predformer(config);
        case NetworkKind::horizonnet:
            return make_horizonnet(config);
    }
    return nullptr;
}

torch::nn::Conv2d conv(int in, int out, int kernel, int stride) {
    return torch::nn::Conv2d(
        torch::nn::Conv2dOptions(in, out, kernel).stride(stride).padding(kernel / 2));
}

torch::nn::GroupNorm group_norm(int channels) {
    return torch::nn::GroupNorm(torch::nn::GroupNormOptions(8, channels));
}

torch::Tensor twice_as_large(const torch::Tensor& x) {
    namespace F = torch::nn::functional;
    return F::interpolate(x, F::InterpolateFuncOptions()
                                 .scale_factor(std::vector<double>{2, 2})
                                 .mode(torch::kBilinear)
                                 .align_corners(false));
}

torch::Tensor median_frame(const torch::Tensor& frames) {
    const std::int64_t n = frames.size(1);
    const torch::Tensor sorted = std::get<0>(frames.sort(1));
    if (n % 2 == 1) return sorted.select(1, n / 2);
    return 0.5 * (sorted.select(1, n / 2 - 1) + sorted.select(1, n / 2));
}

void start_at_zero(const torch::nn::Conv2d& layer) {
    torch::nn::init::zeros_(layer->weight);
    if (layer->bias.defined()) torch::nn::init::zeros_(layer->bias);
}
void start_at_zero(const torch::nn::Linear& layer) {
    torch::nn::init::zeros_(layer->weight);
    if (layer->bias.defined()) torch::nn::init::zeros_(layer->bias);
}

}  // namespace verdigris
