// SPDX-License-Identifier: MIT
// What the structured network promises whatever its weights are.
#include "verdigris/learn/patinanet.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace verdigris {
namespace {

torch::Tensor some_context() {
    torch::manual_seed(5);
    return torch::rand({2, 5, 3, 32, 32});
}

/// Weights far from where they start: the promises are of the structure, not of the start.
std::shared_ptr<PatinaNet> wild_network(double pace) {
    torch::manual_seed(11);
    auto network = std::make_shared<PatinaNet>(NetworkConfig{.size = 32});
    const torch::NoGradGuard frozen;
    for (torch::Tensor& p : network->parameters()) p.add_(0.3 * torch::randn_like(p));
    network->named_parameters()["pace2.bias"].fill_(pace);
    return network;
}

TEST(PatinaNet, StateIsBoundedAndNeverFallsAtAnyHorizon) {
    const torch::NoGradGuard frozen;
    for (const double pace : {-4.0, 2.0, 30.0}) {
        const auto network = wild_network(pace);
        const auto encoded = network->encode(some_context());
        torch::Tensor state = encoded.state;
        std::int64_t negative_steps = 0, moved = 0;
        for (int k = 0; k < 300; ++k) {
            const torch::Tensor next = network->step(encoded, state);
            negative_steps += (next < state).sum().item<std::int64_t>();
            moved += (next > state).sum().item<std::int64_t>();
            state = next;
        }
        EXPECT_EQ(negative_steps, 0);
        EXPECT_GT(moved, 1000);
        EXPECT_GE(state.min().item<float>(), 0);
        EXPECT_LE(state.max().item<float>(), 1);
        EXPECT_TRUE(torch::isfinite(state).all().item<bool>());
    }
}

TEST(PatinaNet, SpreadStaysWithinItsBoundOfStability) {
    const auto network = wild_network(0);
    const torch::NoGradGuard frozen;
    for (const double logit : {-50.0, 0.0, 50.0}) {
        network->named_parameters()["spread"].fill_(logit);
        const double spread = network->spread().item<double>();
        EXPECT_GE(spread, 0);
        EXPECT_LE(spread, 0.25);
    }
}

// Checkerboard, impulse, random: non-negative, never above the maximum, sum kept.
TEST(PatinaNet, SpreadingKeepsTheSumAndMakesNothingNegative) {
    const torch::Tensor y = torch::arange(16).view({16, 1}), x = torch::arange(16).view({1, 16});
    torch::Tensor impulse = torch::zeros({16, 16});
    impulse[0][5] = 1;
    torch::manual_seed(1);
    for (const torch::Tensor& field :
         {((y + x) % 2).to(torch::kFloat64), impulse.to(torch::kFloat64),
          torch::rand({16, 16}, torch::kFloat64)}) {
        for (const double spread : {0.0, 0.1, 0.25}) {
            const torch::Tensor out = spread_increment(field.view({1, 1, 16, 16}),
                                                       torch::tensor(spread, torch::kFloat64));
            EXPECT_GE(out.min().item<double>(), 0);
            EXPECT_LE(out.max().item<double>(), field.max().item<double>() + 1e-15);
            EXPECT_NEAR(out.sum().item<double>(), field.sum().item<double>(), 1e-12);
        }
    }
    // Beyond the bound the checkerboard does go negative: the bound is the bound.
    const torch::Tensor out =
        spread_increment(((y + x) % 2).to(torch::kFloat64).view({1, 1, 16, 16}),
                         torch::tensor(0.3, torch::kFloat64));
    EXPECT_LT(out.min().item<double>(), -0.1);
}

TEST(PatinaNet, SpreadIsThePapersLaplacian) {
    torch::Tensor impulse = torch::zeros({1, 1, 5, 5}, torch::kFloat64);
    impulse[0][0][2][2] = 1;
    const torch::Tensor out = spread_increment(impulse, torch::tensor(0.2, torch::kFloat64))[0][0];
    EXPECT_NEAR(out[2][2].item<double>(), 1 - 4 * 0.2, 1e-15);
    EXPECT_NEAR(out[1][2].item<double>(), 0.2, 1e-15);
    EXPECT_NEAR(out[2][3].item<double>(), 0.2, 1e-15);
    EXPECT_EQ(out[1][1].item<double>(), 0);
}

TEST(PatinaNet, NoPaceIsPersistence) {
    const auto network = wild_network(-1e4);  // softplus gives an exact 0
    const torch::NoGradGuard frozen;
    network->named_parameters()["pace2.weight"].zero_();
    const torch::Tensor context = some_context();
    const torch::Tensor out = network->predict(context, {1, 10, 85});
    EXPECT_TRUE(torch::equal(out, context.narrow(1, 4, 1).expand_as(out)));
}

// Even contexts: the mean of the two middle frames, where torch::median takes the lower.
TEST(PatinaNet, CanvasIsTheMedian) {
    PatinaNet network(NetworkConfig{.context = 4, .size = 16});
    torch::Tensor context = torch::zeros({1, 4, 3, 16, 16});
    const float levels[] = {0.8f, 0.1f, 0.4f, 0.2f};
    for (int i = 0; i < 4; ++i) context.select(1, i).fill_(levels[i]);
    const torch::NoGradGuard frozen;
    EXPECT_NEAR(network.encode(context).canvas[0][1][3][3].item<float>(), 0.3, 1e-7);
}

}  // namespace
}  // namespace verdigris
