// SPDX-License-Identifier: MIT
#include "verdigris/learn/training_set.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include "verdigris/error.h"
#include "verdigris/evaluate/masked_error.h"
#include "verdigris/learn/tensor_image.h"
#include "verdigris/learn/testing.h"

namespace verdigris {
namespace {

using namespace verdigris::testing;

TEST(TrainingSet, AWindowIsTheProtocolsSamples) {
    const Observation o = changing_recording(16, 60);
    const EvaluationProtocol protocol = small_protocol();
    const SampleRange range{5, 35};
    const TrainingSet set(protocol, o, range, {});
    EXPECT_EQ(set.count(), 30 - protocol.span());
    const torch::Tensor window = set.windows({2})[0];
    const std::vector<int> samples = window_samples(protocol, 7);
    ASSERT_EQ(std::size_t(window.size(0)), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        EXPECT_TRUE(torch::equal(window[std::int64_t(i)], tensor_of(o.store->image(samples[i]))));
    }
    EXPECT_EQ(set.chosen(3), (std::vector<int>{0, set.count() / 3, 2 * set.count() / 3}));
}

// The loss's measure is the protocol's: the same mask, the same mean.
TEST(TrainingSet, MaskAndErrorAreTheProtocols) {
    const Observation o = changing_recording(16, 60);
    const EvaluationProtocol protocol = small_protocol();
    const TrainingSet set(protocol, o, {0, 40}, {});
    const torch::Tensor windows = set.windows({3});
    const torch::Tensor mask =
        foreground_mask(windows, protocol.context, torch::full({1}, float(set.tau())));
    std::vector<Image<SrgbF>> frames;
    for (int i = 0; i < windows.size(1); ++i) frames.push_back(image_of(windows[0][i]));
    const PixelWeights all = weights_of({}, 16, 16);
    std::vector<PixelWeights> expected;
    Image<SrgbF> canvas;
    std::vector<float> scratch;
    const std::span<const Image<SrgbF>> context(frames.data(), 3);
    canvas_of(context, canvas, scratch);
    std::vector<const Image<SrgbF>*> truths;
    for (std::size_t k = 3; k < frames.size(); ++k) truths.push_back(&frames[k]);
    foreground_of(truths, canvas, set.tau(), MaskRule::union_of_horizons, all, expected);
    EXPECT_EQ(mask.sum().item<double>(), double(expected[0].count));
    EXPECT_GT(expected[0].count, 60);
    EXPECT_LT(expected[0].count, 256);
    const WindowErrors e =
        window_errors_of(windows.narrow(1, 2, 1), windows.narrow(1, 3, 4), mask, 8);
    for (int k = 0; k < 4; ++k) {
        const MaskedError m = masked_error(frames[2], *truths[std::size_t(k)], expected[0], all);
        EXPECT_NEAR(e.foreground[0][k].item<double>(), m.foreground, 1e-5 * m.foreground + 1e-12);
        EXPECT_NEAR(e.all[0][k].item<double>(), m.specimen, 1e-5 * m.specimen + 1e-12);
    }
}

TEST(TrainingSet, AWindowWithoutForegroundCountsWithAllItsPixelsOnly) {
    const torch::Tensor predicted = torch::full({2, 1, 3, 8, 8}, 0.5),
                        truth = torch::full({2, 1, 3, 8, 8}, 0.4);
    torch::Tensor mask = torch::zeros({2, 1, 1, 8, 8});
    mask[0].fill_(1);
    const WindowErrors e = window_errors_of(predicted, truth, mask, 4);
    EXPECT_EQ(e.counted[0].item<float>(), 1);
    EXPECT_EQ(e.counted[1].item<float>(), 0);
    EXPECT_EQ(e.foreground[1][0].item<float>(), 0);
    // One foreground part of 0.01, a tenth of 0.01 over all pixels, in units of 0.01.
    EXPECT_NEAR(window_loss(e, torch::ones({1}), 0.01).item<double>(), 1.1, 1e-5);
}

TEST(TrainingSet, RefusesWhatItCannotLearnFrom) {
    const Observation o = changing_recording(16, 60);
    EXPECT_THROW(TrainingSet(small_protocol(), o, {0, 10}, {}), Error);
}

TEST(TrainingSet, StretchesWhatIsNoSquare) {
    EXPECT_EQ(learned_size(111, 128), 128);
    EXPECT_EQ(learned_size(20, 20), 24);
    const Observation flat = observed("flat", 28, 14, 60, [](int x, int, int t) {
        return SrgbF{0.01f * float(x), 0.5f, 0.001f * float(t)};
    });
    const TrainingSet set(small_protocol(), flat, {0, 40}, {});
    EXPECT_EQ(set.size(), 32);
    const torch::Tensor first = set.windows({0})[0][0];
    EXPECT_NEAR(first[0][16][16].item<float>(), 0.01 * (16.5 * 28 / 32 - 0.5), 1e-5);
    EXPECT_NEAR(first[1].max().item<float>(), 0.5, 1e-6);
}

}  // namespace
}  // namespace verdigris
