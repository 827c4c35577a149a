// SPDX-License-Identifier: MIT
#include "verdigris/learn/augment.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <algorithm>
#include <set>

namespace verdigris {
namespace {

torch::Tensor some_windows(int batch, int frames) {
    torch::manual_seed(2);
    return torch::rand({batch, frames, 3, 32, 32});
}

// A window of one frame many times stays one frame many times, to the bit: whatever is done is done
// to every frame alike.
TEST(Augment, EveryFrameOfAWindowIsTreatedAlike) {
    const torch::Tensor frame = some_windows(1, 1);
    const torch::Tensor window = frame.expand({1, 15, 3, 32, 32}).contiguous();
    int resampled = 0, flipped = 0;
    for (int step = 0; step < 60; ++step) {
        const WindowAugmentation a = draw_augmentation(9, step, 0);
        resampled += a.resample;
        flipped += a.flip;
        const torch::Tensor out = augmented(window, {a});
        EXPECT_TRUE(torch::equal(out, out.narrow(1, 0, 1).expand_as(out))) << "step " << step;
        // And each frame as if it were alone.
        EXPECT_TRUE(torch::equal(out.narrow(1, 0, 1), augmented(frame, {a})));
    }
    EXPECT_GT(resampled, 30);
    EXPECT_LT(resampled, 60);
    EXPECT_GT(flipped, 15);
}

TEST(Augment, WindowsOfABatchDoNotMix) {
    const torch::Tensor windows = some_windows(3, 4);
    std::vector<WindowAugmentation> draws;
    for (int i = 0; i < 3; ++i) draws.push_back(draw_augmentation(1, 5, i));
    const torch::Tensor all = augmented(windows, draws);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(torch::equal(all.narrow(0, i, 1),
                                 augmented(windows.narrow(0, i, 1), {draws[std::size_t(i)]})));
    }
}

TEST(Augment, IsWhatItSays) {
    const torch::Tensor windows = some_windows(1, 2);
    EXPECT_TRUE(torch::equal(augmented(windows, {{}}), windows));
    EXPECT_TRUE(torch::equal(augmented(windows, {{.flip = true}}), windows.flip({4})));
    const torch::Tensor light = augmented(windows, {{.gain = 1.05, .bias = -0.02}});
    EXPECT_LT((light - (1.05 * windows - 0.02)).abs().max().item<float>(), 1e-6);
    // A whole pixel to the right in the source: what was at x + 2 is at x.
    const torch::Tensor moved = augmented(windows, {{.resample = true, .shift_x = 2}});
    EXPECT_LT((moved.narrow(4, 0, 30) - windows.narrow(4, 2, 30)).abs().max().item<float>(), 1e-5);
    // A flip that is resampled is the flip.
    const torch::Tensor flipped = augmented(windows, {{.flip = true, .resample = true}});
    EXPECT_LT((flipped - windows.flip({4})).abs().max().item<float>(), 1e-5);
}

TEST(Augment, DrawsAreWithinThePapersRangesAndRepeatable) {
    double least_gain = 2, most_gain = 0, least_zoom = 2, most_shift = 0;
    for (int step = 0; step < 500; ++step) {
        const WindowAugmentation a = draw_augmentation(0, step, 1),
                                 b = draw_augmentation(0, step, 1);
        EXPECT_EQ(a.gain, b.gain);
        EXPECT_EQ(a.shift_x, b.shift_x);
        least_gain = std::min(least_gain, a.gain), most_gain = std::max(most_gain, a.gain);
        least_zoom = std::min(least_zoom, a.zoom);
        most_shift = std::max(most_shift, std::abs(a.shift_y));
        EXPECT_LE(std::abs(a.bias), 0.06);
    }
    EXPECT_GE(least_gain, 0.94);
    EXPECT_LE(most_gain, 1.06);
    EXPECT_GT(most_gain - least_gain, 0.11);
    EXPECT_GE(least_zoom, 0.85);
    EXPECT_LE(most_shift, 4);
    EXPECT_GT(most_shift, 3.8);
}

TEST(Augment, ShufflingIsAPermutationOfSeedAndEpoch) {
    const std::vector<int> order = shuffled(352, 0, 1);
    EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), 352u);
    EXPECT_EQ(order, shuffled(352, 0, 1));
    EXPECT_NE(order, shuffled(352, 0, 2));
    EXPECT_NE(order, shuffled(352, 1, 1));
    EXPECT_FALSE(std::ranges::is_sorted(order));
}

}  // namespace
}  // namespace verdigris
