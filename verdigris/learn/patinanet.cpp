// SPDX-License-Identifier: MIT
#include "verdigris/learn/patinanet.h"

#include <torch/nn/functional/padding.h>
#include <torch/nn/init.h>

#include <numbers>

namespace verdigris {
namespace {

namespace F = torch::nn::functional;
constexpr int kFeatures = 8, kGlobal = 64, kDecoder = 128, kWaves = 4;
constexpr int kDecoded = 3 + 1 + 2 * kWaves + kFeatures;

}  // namespace

torch::Tensor spread_increment(const torch::Tensor& delta, const torch::Tensor& spread) {
    const torch::Tensor p = F::pad(delta, F::PadFuncOptions({1, 1, 1, 1}).mode(torch::kReplicate));
    const std::int64_t h = delta.size(2), w = delta.size(3);
    const auto at = [&](std::int64_t y, std::int64_t x) {
        return p.narrow(2, y, h).narrow(3, x, w);
    };
    // As a combination of neighbors and not as a difference: stays non-negative in floats too.
    return (1 - 4 * spread) * delta + spread * ((at(0, 1) + at(2, 1)) + (at(1, 0) + at(1, 2)));
}

PatinaNet::PatinaNet(const NetworkConfig& config)
    : a0_(register_module("a0", conv(3 + 3 * config.context, 24, 3))),
      a1_(register_module("a1", conv(24, 48, 3, 2))),
      a2_(register_module("a2", conv(48, 64, 3, 2))),
      a3_(register_module("a3", conv(64, 64, 3))),
      y1_(register_module("y1", conv(64 + 48, 48, 3))),
      y0_(register_module("y0", conv(48 + 24, 24, 3))),
      n0_(register_module("n0", group_norm(24))),
      n1_(register_module("n1", group_norm(48))),
      n2_(register_module("n2", group_norm(64))),
      n3_(register_module("n3", group_norm(64))),
      m1_(register_module("m1", group_norm(48))),
      m0_(register_module("m0", group_norm(24))),
      susceptibility_(register_module("susceptibility", conv(24, 1, 1))),
      state_(register_module("state", conv(24, 1, 1))),
      features_(register_module("features", conv(24, kFeatures, 1))),
      global_(register_module("global", torch::nn::Linear(kGlobal + 3 * config.context, kGlobal))),
      pace1_(register_module("pace1", torch::nn::Linear(kGlobal + 1, 32))),
      pace2_(register_module("pace2", torch::nn::Linear(32, 1))),
      decode1_(register_module("decode1", conv(kDecoded, kDecoder, 1))),
      decode2_(register_module("decode2", conv(kDecoder, kDecoder, 1))),
      decode3_(register_module("decode3", conv(kDecoder, 3, 1))) {
    spread_logit_ = register_parameter("spread", torch::zeros({}));
    const torch::NoGradGuard frozen;
    // Small, not zero: the change vanishes at horizon 0 by itself, and a zero would stop the
    // gradient to the state.
    decode3_->weight.mul_(0.1);
}

PatinaNet::Encoded PatinaNet::encode(const torch::Tensor& context) {
    const std::int64_t n = context.size(1);
    Encoded e;
    e.canvas = median_frame(context);
    // Tenfold: a change is a hundredth of a color.
    const torch::Tensor change = 10 * (context - e.canvas.unsqueeze(1)).flatten(1, 2);
    const torch::Tensor x0 = F::silu(n0_(a0_(torch::cat({e.canvas, change}, 1))));
    const torch::Tensor x1 = F::silu(n1_(a1_(x0)));
    const torch::Tensor x2 = F::silu(n3_(a3_(F::silu(n2_(a2_(x1))))));
    const torch::Tensor up1 = F::silu(m1_(y1_(torch::cat({twice_as_large(x2), x1}, 1))));
    const torch::Tensor up0 = F::silu(m0_(y0_(torch::cat({twice_as_large(up1), x0}, 1))));
    e.susceptibility = torch::sigmoid(susceptibility_(up0));
    e.state = torch::sigmoid(state_(up0) - 2);
    e.features = torch::tanh(features_(up0));
    e.global =
        F::silu(global_(torch::cat({x2.mean({2, 3}), change.mean({2, 3}).view({-1, 3 * n})}, 1)));
    return e;
}

torch::Tensor PatinaNet::pace(const Encoded& e, const torch::Tensor& state) {
    const torch::Tensor coordinate = state.mean({2, 3});
    const torch::Tensor hidden = F::silu(pace1_(torch::cat({e.global, coordinate}, 1)));
    return F::softplus(pace2_(hidden) - 4);
}

torch::Tensor PatinaNet::step(const Encoded& e, const torch::Tensor& state) {
    const torch::Tensor left = 1 - state;
    const torch::Tensor delta = e.susceptibility * left * pace(e, state).view({-1, 1, 1, 1});
    const torch::Tensor increment =
        torch::minimum(torch::relu(spread_increment(delta, spread())), left);
    return state + increment;
}

/// The decoder's first layer is linear in [canvas, state, waves, features]: what does not change
/// with the horizon goes through it once.
torch::Tensor PatinaNet::decode_fixed(const Encoded& e) {
    const torch::Tensor w = decode1_->weight;
    const torch::Tensor fixed =
        torch::cat({w.narrow(1, 0, 3), w.narrow(1, kDecoded - kFeatures, kFeatures)}, 1);
    return torch::conv2d(torch::cat({e.canvas, e.features}, 1), fixed, decode1_->bias);
}

torch::Tensor PatinaNet::decode(const torch::Tensor& fixed, const torch::Tensor& state) {
    std::vector<torch::Tensor> waves{state};
    for (int j = 1; j <= kWaves; ++j) {
        const torch::Tensor phase = (std::numbers::pi * j) * state;
        waves.push_back(torch::sin(phase));
        waves.push_back(torch::cos(phase));
    }
    const torch::Tensor w = decode1_->weight.narrow(1, 3, 1 + 2 * kWaves);
    const torch::Tensor x = F::silu(fixed + torch::conv2d(torch::cat(waves, 1), w));
    return decode3_(F::silu(decode2_(x)));
}

torch::Tensor PatinaNet::predict(const torch::Tensor& context, const std::vector<int>& horizons) {
    const Encoded e = encode(context);
    const torch::Tensor last = context.select(1, context.size(1) - 1);
    const torch::Tensor fixed = decode_fixed(e);
    const torch::Tensor now = decode(fixed, e.state);
    torch::Tensor state = e.state;
    std::vector<torch::Tensor> frames;
    for (int k = 1; frames.size() < horizons.size(); ++k) {
        state = step(e, state);
        if (horizons[frames.size()] != k) continue;
        frames.push_back(last + kResidualScale * (decode(fixed, state) - now));
    }
    return torch::stack(frames, 1);
}

std::shared_ptr<NetworkModule> make_patinanet(const NetworkConfig& config) {
    return std::make_shared<PatinaNet>(config);
}

}  // namespace verdigris
