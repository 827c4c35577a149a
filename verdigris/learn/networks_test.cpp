// SPDX-License-Identifier: MIT
// The four networks as networks: their sizes, where they start, what shapes they take.
#include <gtest/gtest.h>
#include <torch/utils.h>

#include "verdigris/error.h"
#include "verdigris/learn/learn.h"
#include "verdigris/learn/network_parts.h"

namespace verdigris {
namespace {

torch::Tensor some_context(int size, int n = 5, int batch = 1) {
    torch::manual_seed(3);
    return 0.2 + 0.6 * torch::rand({batch, n, 3, size, size});
}

class Networks : public testing::TestWithParam<NetworkKind> {};
INSTANTIATE_TEST_SUITE_P(, Networks, testing::ValuesIn(kNetworkKinds),
                         [](const auto& one) { return to_string(one.param); });

// [Paper], Table 1: 0.17M, 1.65M, 1.67M, 0.92M.
TEST(NetworkSizes, AreThePapers) {
    const auto size_of = [](NetworkKind kind) { return Network({.kind = kind}).parameter_count(); };
    EXPECT_EQ(size_of(NetworkKind::patinanet), 170623);
    EXPECT_EQ(size_of(NetworkKind::convlstm), 1653000);
    EXPECT_EQ(size_of(NetworkKind::predformer), 1668288);
    EXPECT_EQ(size_of(NetworkKind::horizonnet), 920227);
}

TEST_P(Networks, SameSeedSameWeights) {
    const NetworkConfig config{.kind = GetParam(), .size = 32};
    const Network one(config, 7), two(config, 7), other(config, 8);
    bool differs = false;
    const auto a = one.parts().module->parameters(), b = two.parts().module->parameters(),
               c = other.parts().module->parameters();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_TRUE(torch::equal(a[i], b[i]));
        differs = differs || !torch::equal(a[i], c[i]);
    }
    EXPECT_TRUE(differs);
}

// Residual on the last frame with a head that starts at zero. Not patinanet, whose change is that
// of a state that moves a little from the first step on.
TEST_P(Networks, StartsAsPersistence) {
    const Network network({.kind = GetParam(), .size = 32});
    const torch::Tensor context = some_context(32);
    const torch::NoGradGuard frozen;
    const torch::Tensor out = network.parts().module->predict(context, units_to(12));
    ASSERT_EQ(out.sizes(), (std::vector<std::int64_t>{1, 12, 3, 32, 32}));
    const torch::Tensor change = (out - context.narrow(1, 4, 1)).abs().amax({0, 2, 3, 4});
    if (GetParam() == NetworkKind::patinanet) {
        EXPECT_LT(change[0].item<float>(), 1e-3);
        return;
    }
    EXPECT_EQ(change[0].item<float>(), 0);
    EXPECT_LT(change[11].item<float>(), 1e-6);  // a second chunk starts from the first
}

TEST_P(Networks, AskingForSomeHorizonsGivesTheSameFrames) {
    const Network network({.kind = GetParam(), .size = 32});
    const torch::NoGradGuard frozen;
    for (torch::Tensor& p : network.parts().module->parameters())
        p.add_(0.01 * torch::randn_like(p));
    const torch::Tensor context = some_context(32, 5, 2);
    const torch::Tensor all = network.parts().module->predict(context, units_to(11));
    const torch::Tensor some = network.parts().module->predict(context, {2, 5, 6, 11});
    for (const auto& [at, k] : {std::pair{0, 2}, {1, 5}, {2, 6}, {3, 11}}) {
        EXPECT_LT((some.select(1, at) - all.select(1, k - 1)).abs().max().item<float>(), 2e-6)
            << "horizon " << k;
    }
    EXPECT_GT((all.select(1, 10) - all.select(1, 0)).abs().max().item<float>(), 1e-5);
}

// In doubles, so that a finite difference means something.
TEST_P(Networks, GradientsAreThoseOfFiniteDifferences) {
    const Network network({.kind = GetParam(), .context = 3, .size = 16});
    NetworkModule& module = *network.parts().module;
    module.to(torch::kFloat64);
    {
        const torch::NoGradGuard frozen;
        for (torch::Tensor& p : module.parameters()) p.add_(0.02 * torch::randn_like(p));
    }
    const torch::Tensor context = some_context(16, 3).to(torch::kFloat64);
    const torch::Tensor truth = some_context(16, 4).to(torch::kFloat64);
    const auto loss = [&] { return (module.predict(context, units_to(4)) - truth).pow(2).sum(); };
    module.zero_grad();
    loss().backward();
    int checked = 0;
    for (const auto& item : module.named_parameters()) {
        torch::Tensor p = item.value();
        ASSERT_TRUE(p.grad().defined()) << item.key() << " is not used";
        torch::Tensor flat = p.detach().view({-1});
        const torch::Tensor gradient = p.grad().view({-1});
        const std::int64_t i = gradient.abs().argmax().item<std::int64_t>();
        const double at = flat[i].item<double>(), h = 1e-5;
        const torch::NoGradGuard frozen;
        flat[i] = at + h;
        const double up = loss().item<double>();
        flat[i] = at - h;
        const double down = loss().item<double>();
        flat[i] = at;
        const double g = gradient[i].item<double>();
        EXPECT_NEAR((up - down) / (2 * h), g, 1e-4 * std::abs(g) + 1e-6) << item.key();
        ++checked;
    }
    EXPECT_GT(checked, 10);
}

TEST_P(Networks, ForecasterSpeaksTheHouseLanguage) {
    auto network = std::make_shared<const Network>(NetworkConfig{.kind = GetParam(), .size = 32});
    const Forecaster forecaster = as_forecaster(network, "mine", units_to(6));
    Context context;
    for (int i = 0; i < 5; ++i) {
        Image<SrgbF> frame(48, 40);  // not the network's size
        for (SrgbF& p : frame.pixels()) p = {0.5f, 0.25f + 0.01f * float(i), 0.125f};
        context.frames.push_back(std::move(frame));
    }
    const Forecast forecast = forecaster.forecast(context);
    EXPECT_EQ(forecast.forecaster, "mine");
    ASSERT_EQ(forecast.stack.frames.size(), 6u);
    EXPECT_EQ(forecast.stack.horizons.back(), 6);
    const Image<SrgbF> at0 = forecast.at(0), at6 = forecast.at(6);
    EXPECT_EQ(at0(20, 20).g, context.frames.back()(20, 20).g);
    EXPECT_NEAR(at6(20, 20).g, context.frames.back()(20, 20).g, 2e-3);
    context.frames.pop_back();
    EXPECT_THROW(forecaster.forecast(context), Error);
}

TEST(NetworkConfigs, AreChecked) {
    EXPECT_THROW(Network({.size = 60}), Error);
    EXPECT_THROW(Network({.context = 1}), Error);
    EXPECT_THROW(network_kind("resnet"), Error);
    EXPECT_THROW(device_from("tpu"), Error);
}

}  // namespace
}  // namespace verdigris
