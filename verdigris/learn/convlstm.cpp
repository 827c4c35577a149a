// SPDX-License-Identifier: MIT
// ConvLSTM encoder and forecaster [Shi2015]: two levels on patches of 4 x 4, states handed from one
// to the other, the forecaster fed with nothing. The paper gives only its size, 1.65 M.
#include <torch/nn/functional/activation.h>
#include <torch/nn/functional/pixelshuffle.h>

#include "verdigris/learn/network_module.h"

namespace verdigris {
namespace {

constexpr int kPatch = 4, kHidden = 80, kHead = 88, kPatchChannels = 3 * kPatch * kPatch;

struct State {
    torch::Tensor hidden, cell;
};

/// [i, f, g, o] = conv(cat(x, h)); no peepholes. `in` 0: the state alone drives it.
class Cell : public torch::nn::Module {
  public:
    explicit Cell(int in) : gates_(register_module("gates", conv(in + kHidden, 4 * kHidden, 3))) {}

    State operator()(const torch::Tensor& x, const State& before) {
        const torch::Tensor input = x.defined() ? torch::cat({x, before.hidden}, 1) : before.hidden;
        const std::vector<torch::Tensor> gate = gates_(input).chunk(4, 1);
        // Forget gate + 1: remembers from the start.
        const torch::Tensor cell = torch::sigmoid(gate[1] + 1) * before.cell +
                                   torch::sigmoid(gate[0]) * torch::tanh(gate[2]);
        return {torch::sigmoid(gate[3]) * torch::tanh(cell), cell};
    }

  private:
    torch::nn::Conv2d gates_;
};

class ConvLstm final : public NetworkModule {
  public:
    ConvLstm()
        : encoder1_(register_module("encoder1", std::make_shared<Cell>(kPatchChannels))),
          encoder2_(register_module("encoder2", std::make_shared<Cell>(kHidden))),
          forecaster2_(register_module("forecaster2", std::make_shared<Cell>(0))),
          forecaster1_(register_module("forecaster1", std::make_shared<Cell>(kHidden))),
          head1_(register_module("head1", conv(2 * kHidden, kHead, 3))),
          head2_(register_module("head2", conv(kHead, kPatchChannels, 1))) {
        start_at_zero(head2_);
    }

    torch::Tensor predict(const torch::Tensor& context, const std::vector<int>& horizons) override {
        namespace F = torch::nn::functional;
        const std::int64_t batch = context.size(0), n = context.size(1);
        const torch::Tensor patches = torch::pixel_unshuffle(context, kPatch);
        const torch::Tensor zero =
            torch::zeros({batch, kHidden, context.size(3) / kPatch, context.size(4) / kPatch},
                         context.options());
        State first{zero, zero}, second{zero, zero};
        for (std::int64_t i = 0; i < n; ++i) {
            first = (*encoder1_)(patches.select(1, i), first);
            second = (*encoder2_)(first.hidden, second);
        }
        const torch::Tensor last = context.select(1, n - 1);
        std::vector<torch::Tensor> frames;
        std::size_t asked = 0;
        for (int k = 1; asked < horizons.size(); ++k) {
            second = (*forecaster2_)({}, second);
            first = (*forecaster1_)(second.hidden, first);
            if (horizons[asked] != k) continue;
            ++asked;
            const torch::Tensor change =
                head2_(F::silu(head1_(torch::cat({first.hidden, second.hidden}, 1))));
            frames.push_back(last + kResidualScale * torch::pixel_shuffle(change, kPatch));
        }
        return torch::stack(frames, 1);
    }

  private:
    std::shared_ptr<Cell> encoder1_, encoder2_, forecaster2_, forecaster1_;
    torch::nn::Conv2d head1_, head2_;
};

}  // namespace

std::shared_ptr<NetworkModule> make_convlstm(const NetworkConfig&) {
    return std::make_shared<ConvLstm>();
}

}  // namespace verdigris
