// SPDX-License-Identifier: MIT
// PredFormer [Tang2024]: gated attention units over time and over space in turn (binary TS, three
// times), patches of 8 x 8, learned positions. As many frames out as in: a longer horizon feeds the
// frames back, which is why its error is worst where a chunk ends. The paper gives only its size.
#include <torch/nn/functional/activation.h>
#include <torch/nn/init.h>
#include <torch/nn/modules/container/modulelist.h>

#include <cmath>

#include "verdigris/learn/network_module.h"

namespace verdigris {
namespace {

namespace F = torch::nn::functional;
constexpr int kPatch = 8, kWidth = 128, kHeads = 4, kHiddenWidth = 512, kPairs = 3;
constexpr int kPatchChannels = 3 * kPatch * kPatch;
constexpr double kStd = 0.02;

torch::nn::Linear linear(int in, int out, bool bias = true) {
    torch::nn::Linear layer(torch::nn::LinearOptions(in, out).bias(bias));
    const torch::NoGradGuard frozen;
    // Normal, cut at two standard deviations; clipping moves 5 % of the weights to the cut.
    layer->weight.normal_(0, kStd).clamp_(-2 * kStd, 2 * kStd);
    if (bias) layer->bias.zero_();
    return layer;
}

torch::nn::LayerNorm layer_norm() {
    return torch::nn::LayerNorm(torch::nn::LayerNormOptions({kWidth}));
}

/// Attention and a gated perceptron, both residual, closed by a norm. [sequences, length, 128].
class Unit : public torch::nn::Module {
  public:
    Unit()
        : norm1_(register_module("norm1", layer_norm())),
          qkv_(register_module("qkv", linear(kWidth, 3 * kWidth, false))),
          project_(register_module("project", linear(kWidth, kWidth))),
          norm2_(register_module("norm2", layer_norm())),
          gate_(register_module("gate", linear(kWidth, kHiddenWidth))),
          value_(register_module("value", linear(kWidth, kHiddenWidth))),
          down_(register_module("down", linear(kHiddenWidth, kWidth))),
          norm3_(register_module("norm3", layer_norm())) {}

    torch::Tensor operator()(torch::Tensor x) {
        const std::int64_t sequences = x.size(0), length = x.size(1), each = kWidth / kHeads;
        // [3, sequences, heads, length, each]
        const torch::Tensor qkv =
            qkv_(norm1_(x)).view({sequences, length, 3, kHeads, each}).permute({2, 0, 3, 1, 4});
        // Written out: libtorch 1.13 has no public scaled_dot_product_attention.
        const torch::Tensor weight = torch::softmax(
            torch::matmul(qkv[0] * (1 / std::sqrt(double(each))), qkv[1].transpose(-2, -1)), -1);
        const torch::Tensor attended =
            torch::matmul(weight, qkv[2]).transpose(1, 2).reshape({sequences, length, kWidth});
        x = x + project_(attended);
        const torch::Tensor y = norm2_(x);
        x = x + down_(F::silu(gate_(y)) * value_(y));
        return norm3_(x);
    }

  private:
    torch::nn::LayerNorm norm1_;
    torch::nn::Linear qkv_, project_;
    torch::nn::LayerNorm norm2_;
    torch::nn::Linear gate_, value_, down_;
    torch::nn::LayerNorm norm3_;
};

class PredFormer final : public NetworkModule {
  public:
    explicit PredFormer(const NetworkConfig& config)
        : embed_(register_module("embed", linear(kPatchChannels, kWidth))),
          norm_(register_module("norm", layer_norm())),
          head_(register_module("head", torch::nn::Linear(kWidth, kPatchChannels))) {
        const int patches = config.size / kPatch * (config.size / kPatch);
        space_ = register_parameter("space", kStd * torch::randn({patches, kWidth}));
        time_ = register_parameter("time", kStd * torch::randn({config.context, kWidth}));
        for (int i = 0; i < 2 * kPairs; ++i) {
            units_.push_back(register_module("unit" + std::to_string(i), std::make_shared<Unit>()));
        }
        start_at_zero(head_);
    }

    torch::Tensor predict(const torch::Tensor& context, const std::vector<int>& horizons) override {
        const std::int64_t n = context.size(1);
        torch::Tensor frames = context;
        std::vector<torch::Tensor> chosen;
        for (std::int64_t done = 0; chosen.size() < horizons.size(); done += n) {
            frames = chunk(frames);
            while (chosen.size() < horizons.size() && horizons[chosen.size()] <= done + n) {
                chosen.push_back(frames.select(1, horizons[chosen.size()] - done - 1));
            }
        }
        return torch::stack(chosen, 1);
    }

  private:
    /// The n frames after these n.
    torch::Tensor chunk(const torch::Tensor& frames) {
        const std::int64_t batch = frames.size(0), n = frames.size(1);
        // [B, n, 192, h, w] -> [B, n, patches, 192]
        const torch::Tensor patches =
            torch::pixel_unshuffle(frames, kPatch).flatten(3).transpose(2, 3);
        const std::int64_t count = patches.size(2);
        torch::Tensor x = embed_(patches) + space_ + time_.unsqueeze(1);
        for (std::size_t i = 0; i < units_.size(); i += 2) {
            x = x.transpose(1, 2).reshape({batch * count, n, kWidth});  // over time
            x = (*units_[i])(x);
            x = x.view({batch, count, n, kWidth}).transpose(1, 2);
            x = x.reshape({batch * n, count, kWidth});  // over space
            x = (*units_[i + 1])(x).view({batch, n, count, kWidth});
        }
        const std::int64_t rows = frames.size(3) / kPatch, columns = frames.size(4) / kPatch;
        const torch::Tensor change =
            head_(norm_(x)).transpose(2, 3).reshape({batch, n, kPatchChannels, rows, columns});
        return frames.narrow(1, n - 1, 1) + kResidualScale * torch::pixel_shuffle(change, kPatch);
    }

    torch::nn::Linear embed_;
    torch::Tensor space_, time_;
    std::vector<std::shared_ptr<Unit>> units_;
    torch::nn::LayerNorm norm_;
    torch::nn::Linear head_;
};

}  // namespace

std::shared_ptr<NetworkModule> make_predformer(const NetworkConfig& config) {
    return std::make_shared<PredFormer>(config);
}

}  // namespace verdigris
