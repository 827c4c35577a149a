// SPDX-License-Identifier: MIT
// The paper's direct network: the context is encoded once, the horizon asked for enters as a
// sinusoidal embedding that scales and shifts features [Perez2018], and a U-Net decoder answers
// with the change of the last frame. Sizes are ours; the paper gives their sum, 0.92 M.
#include <torch/nn/functional/activation.h>

#include <cmath>

#include "verdigris/learn/network_module.h"

namespace verdigris {
namespace {

namespace F = torch::nn::functional;
constexpr int kEmbedding = 128;

/// sin and cos of 64 frequencies 1000^(-j / 64), the horizon in units and not normalized: 20 and 50
/// stay apart. [horizons, 128].
torch::Tensor horizon_features(const std::vector<int>& horizons, const torch::Tensor& like) {
    const int half = kEmbedding / 2;
    torch::Tensor features = torch::empty({std::int64_t(horizons.size()), kEmbedding});
    auto at = features.accessor<float, 2>();
    for (std::size_t i = 0; i < horizons.size(); ++i) {
        for (int j = 0; j < half; ++j) {
            const double phase = horizons[i] * std::pow(1000.0, -double(j) / half);
            at[std::int64_t(i)][j] = float(std::sin(phase));
            at[std::int64_t(i)][j + half] = float(std::cos(phase));
        }
    }
    return features.to(like.options());
}

/// Convolution, group norm, scaled and shifted by the horizon.
class Modulated : public torch::nn::Module {
  public:
    Modulated(int in, int out)
        : channels_(out),
          conv_(register_module("conv", conv(in, out, 3))),
          norm_(register_module("norm", group_norm(out))),
          film_(register_module("film", torch::nn::Linear(kEmbedding, 2 * out))) {}

    /// embedding [batch of x, 128].
    torch::Tensor operator()(const torch::Tensor& x, const torch::Tensor& embedding) {
        const torch::Tensor film = film_(embedding).view({-1, 2 * channels_, 1, 1});
        const std::vector<torch::Tensor> part = film.chunk(2, 1);
        return norm_(conv_(x)) * (1 + part[0]) + part[1];
    }

  private:
    std::int64_t channels_;
    torch::nn::Conv2d conv_;
    torch::nn::GroupNorm norm_;
    torch::nn::Linear film_;
};

/// Convolution, group norm, SiLU.
class Block : public torch::nn::Module {
  public:
    Block(int in, int out, int stride = 1)
        : conv_(register_module("conv", conv(in, out, 3, stride))),
          norm_(register_module("norm", group_norm(out))) {}
    torch::Tensor operator()(const torch::Tensor& x) { return F::silu(norm_(conv_(x))); }

  private:
    torch::nn::Conv2d conv_;
    torch::nn::GroupNorm norm_;
};

class HorizonNet final : public NetworkModule {
  public:
    explicit HorizonNet(const NetworkConfig& config)
        : c0_(add<Block>("c0", 3 * config.context, 32)),
          d1_(add<Block>("d1", 32, 64, 2)),
          c1_(add<Block>("c1", 64, 64)),
          d2_(add<Block>("d2", 64, 128, 2)),
          c2_(add<Block>("c2", 128, 128)),
          embed1_(register_module("embed1", torch::nn::Linear(kEmbedding, 256))),
          embed2_(register_module("embed2", torch::nn::Linear(256, kEmbedding))),
          middle1_(add<Modulated>("middle1", 128, 128)),
          middle2_(add<Modulated>("middle2", 128, 128)),
          u1_(add<Modulated>("u1", 128 + 64, 64)),
          u1b_(add<Block>("u1b", 64, 64)),
          u0_(add<Modulated>("u0", 64 + 32, 32)),
          u0b_(add<Block>("u0b", 32, 32)),
          out_(register_module("out", conv(32, 3, 3))) {
        start_at_zero(out_);
    }

    torch::Tensor predict(const torch::Tensor& context, const std::vector<int>& horizons) override {
        const std::int64_t batch = context.size(0), count = std::int64_t(horizons.size());
        const torch::Tensor full = (*c0_)(context.flatten(1, 2));
        const torch::Tensor half = (*c1_)((*d1_)(full));
        const torch::Tensor quarter = (*c2_)((*d2_)(half));
        const torch::Tensor per_horizon =
            embed2_(F::silu(embed1_(horizon_features(horizons, context))));
        // Batch and horizon become one axis: [b0 h0, b0 h1, ..., b1 h0, ...].
        const torch::Tensor embedding = per_horizon.repeat({batch, 1});
        const auto each = [count](const torch::Tensor& x) { return x.repeat_interleave(count, 0); };
        torch::Tensor x = each(quarter);
        const torch::Tensor inner = F::silu((*middle1_)(x, embedding));
        x = x + F::silu((*middle2_)(inner, embedding));
        x = torch::cat({twice_as_large(x), each(half)}, 1);
        x = (*u1b_)(F::silu((*u1_)(x, embedding)));
        x = torch::cat({twice_as_large(x), each(full)}, 1);
        x = (*u0b_)(F::silu((*u0_)(x, embedding)));
        const torch::Tensor change =
            out_(x).view({batch, count, 3, context.size(3), context.size(4)});
        return context.narrow(1, context.size(1) - 1, 1) + kResidualScale * change;
    }

  private:
    template <class M, class... A>
    std::shared_ptr<M> add(const char* name, A... a) {
        return register_module(name, std::make_shared<M>(a...));
    }
    std::shared_ptr<Block> c0_, d1_, c1_, d2_, c2_;
    torch::nn::Linear embed1_, embed2_;
    std::shared_ptr<Modulated> middle1_, middle2_, u1_;
    std::shared_ptr<Block> u1b_;
    std::shared_ptr<Modulated> u0_;
    std::shared_ptr<Block> u0b_;
    torch::nn::Conv2d out_;
};

}  // namespace

std::shared_ptr<NetworkModule> make_horizonnet(const NetworkConfig& config) {
    return std::make_shared<HorizonNet>(config);
}

}  // namespace verdigris
