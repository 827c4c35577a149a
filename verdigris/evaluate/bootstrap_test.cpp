// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

#include "verdigris/error.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

WindowRatios constant_in_blocks(const std::vector<double>& model, int per_block,
                                const std::vector<double>& persistence) {
    WindowRatios r;
    for (std::size_t b = 0; b < model.size(); ++b) {
        for (int i = 0; i < per_block; ++i) {
            r.starts.push_back(int(b) * per_block + i);
            r.over.push_back(persistence[b] - model[b]);
            r.under.push_back(persistence[b]);
        }
    }
    return r;
}

TEST(Bootstrap, SixBlocksAreEnumeratedExactly) {
    // Of equal weight, theta is the mean of six draws from six gains. Against brute force over all
    // 6^6 ordered draws.
    const std::vector<double> held(6, 1.0), model{0.2, 0.5, 0.9, 1.4, 0.7, 0.4};
    const WindowRatios r = constant_in_blocks(model, 140, held);
    const auto exact = bootstrap(r, BootstrapKind::block);
    ASSERT_TRUE(exact);
    std::vector<double> all;
    for (int code = 0; code < 46656; ++code) {
        double sum = 0;
        for (int k = 0, c = code; k < 6; ++k, c /= 6) sum += 1 - model[std::size_t(c % 6)];
        all.push_back(sum / 6);
    }
    std::ranges::sort(all);
    EXPECT_NEAR(exact->low, all[std::size_t(std::ceil(0.025 * 46656)) - 1], 1e-12);
    EXPECT_NEAR(exact->high, all[std::size_t(std::ceil(0.975 * 46656)) - 1], 1e-12);
    EXPECT_NEAR(ratio(r), 1 - (0.2 + 0.5 + 0.9 + 1.4 + 0.7 + 0.4) / 6, 1e-12);
}

TEST(Bootstrap, TheWeightsOfTheMultisetsAddUpToOne) {
    // Two blocks: 25 % both first, 50 % mixed, 25 % both second. So the 90 % interval is the range
    // and the 40 % interval the middle alone.
    const WindowRatios r = constant_in_blocks({0.2, 0.6}, 10, {1, 1});
    const auto wide = bootstrap(r, BootstrapKind::block, {100, 0, 0.90, 10});
    const auto narrow = bootstrap(r, BootstrapKind::block, {100, 0, 0.40, 10});
    EXPECT_NEAR(wide->low, 0.4, 1e-12);
    EXPECT_NEAR(wide->high, 0.8, 1e-12);
    EXPECT_NEAR(narrow->low, 0.6, 1e-12);
    EXPECT_NEAR(narrow->high, 0.6, 1e-12);
}

TEST(Bootstrap, ThePapers810WindowsAreSixBlocks) {
    WindowRatios r;
    r.starts.resize(810);
    std::iota(r.starts.begin(), r.starts.end(), 17);
    r.over.assign(810, 0.1);
    r.under.assign(810, 1.0);
    const std::vector<BlockGain> blocks = block_gains(r, 140);
    ASSERT_EQ(blocks.size(), 6u);
    for (std::size_t b = 0; b < 5; ++b) EXPECT_EQ(blocks[b].windows, 140);
    EXPECT_EQ(blocks[5].windows, 110);
    EXPECT_EQ(bootstrap_options({}).block, 140);
    EXPECT_EQ(blocks[5].first_start, 717);
    EXPECT_EQ(blocks[5].last_start, 826);
    EXPECT_NEAR(blocks[3].value, 0.1, 1e-12);
    for (const auto kind :
         {BootstrapKind::naive, BootstrapKind::block, BootstrapKind::circular_block}) {
        const auto interval = bootstrap(r, kind);
        EXPECT_NEAR(interval->low, 0.1, 1e-9) << to_string(kind);
        EXPECT_NEAR(interval->high, 0.1, 1e-9) << to_string(kind);
    }
}

TEST(Bootstrap, AShortLastBlockIsPartOfTheOneBeforeIt) {
    const auto windows = [](int count, int step = 1) {
        WindowRatios r;
        for (int i = 0; i < count; ++i) {
            r.starts.push_back(i * step);
            r.over.push_back(i * step < 280 ? 0.5 : 0.25);
            r.under.push_back(1);
        }
        std::vector<int> of_blocks;
        for (const BlockGain& b : block_gains(r, 140)) of_blocks.push_back(b.windows);
        return std::pair(r, of_blocks);
    };
    // One window more than two blocks, one fewer than a half, and a half.
    const auto [one_more, blocks] = windows(281);
    EXPECT_EQ(blocks, (std::vector<int>{140, 141}));
    EXPECT_NEAR(block_gains(one_more, 140)[1].value, (140 * 0.5 + 0.25) / 141, 1e-12);
    EXPECT_EQ(block_gains(one_more, 140)[1].last_start, 280);
    EXPECT_EQ(windows(349).second, (std::vector<int>{140, 209}));
    EXPECT_EQ(windows(350).second, (std::vector<int>{140, 140, 70}));
    // By count, not by samples, so that evenly spaced windows give as many blocks.
    EXPECT_EQ(windows(29, 10).second, (std::vector<int>{14, 15}));
    EXPECT_EQ(windows(81, 10).second, (std::vector<int>{14, 14, 14, 14, 14, 11}));
    // One window beyond a block leaves one block, which resolves nothing.
    const auto [alone, single] = windows(141);
    EXPECT_EQ(single, (std::vector<int>{141}));
    EXPECT_FALSE(bootstrap(alone, BootstrapKind::block));
    EXPECT_FALSE(bootstrap(alone, BootstrapKind::circular_block));
}

TEST(Bootstrap, TheEndOfACircleGoesOnAtItsStart) {
    // Four windows, of which the first gains: blocks of two at the offsets 0 .. 3 hold it at 0 and,
    // across the end, at 3. So two blocks hold it 0, 1, 2 times with probability 1/4, 1/2, 1/4.
    // Without the wrap it would be 4/9, 4/9, 1/9, and the middle 40 % would reach down to 0.
    WindowRatios r;
    r.starts = {0, 1, 2, 3};
    r.over = {1, 0, 0, 0};
    r.under = {1, 1, 1, 1};
    const auto wide = bootstrap(r, BootstrapKind::circular_block, {10000, 0, 0.90, 2});
    const auto narrow = bootstrap(r, BootstrapKind::circular_block, {10000, 0, 0.40, 2});
    EXPECT_NEAR(wide->low, 0, 1e-12);
    EXPECT_NEAR(wide->high, 0.5, 1e-12);
    EXPECT_NEAR(narrow->low, 0.25, 1e-12);
    EXPECT_NEAR(narrow->high, 0.25, 1e-12);
}

TEST(Bootstrap, ItsDrawsCenterOnTheGainWhereTheEndsDiffer) {
    // All gain lies in the first and last 40 of 810 windows, which blocks that stop at the ends
    // draw a sixth as often: their whole 95 % interval lies below the gain.
    WindowRatios r;
    for (int s = 0; s < 810; ++s) {
        r.starts.push_back(s);
        r.over.push_back(s < 40 || s >= 770 ? 0.9 : 0);
        r.under.push_back(1);
    }
    const auto interval = bootstrap(r, BootstrapKind::circular_block);
    EXPECT_LT(interval->low, ratio(r));
    EXPECT_GT(interval->high, ratio(r));
    // The middle of the draws is the gain itself, to what is left of the cut last block.
    const auto middle = bootstrap(r, BootstrapKind::circular_block, {10000, 0, 0.02, 140});
    EXPECT_NEAR(middle->low, ratio(r), 0.01);
}

TEST(Bootstrap, SkippedWindowsLeaveTheirBlocksWhereTheyWere) {
    WindowRatios r;
    for (const int s : {0, 1, 2, 150, 151, 420, 421}) {
        r.starts.push_back(s);
        r.over.push_back(0.5);
        r.under.push_back(s < 140 ? 1 : 2);
    }
    const std::vector<BlockGain> blocks = block_gains(r, 140);
    ASSERT_EQ(blocks.size(), 3u);
    EXPECT_EQ(blocks[0].windows, 3);
    EXPECT_EQ(blocks[1].windows, 2);
    EXPECT_EQ(blocks[2].first_start, 420);
    EXPECT_NEAR(blocks[1].value, 0.25, 1e-12);
    EXPECT_TRUE(bootstrap(r, BootstrapKind::circular_block));
}

TEST(Bootstrap, AWindowByItselfResolvesNothing) {
    WindowRatios r;
    EXPECT_FALSE(bootstrap(r, BootstrapKind::naive));
    EXPECT_TRUE(block_gains(r, 140).empty());
    r = constant_in_blocks({0.5}, 100, {1});
    EXPECT_TRUE(bootstrap(r, BootstrapKind::naive));
    EXPECT_FALSE(bootstrap(r, BootstrapKind::block));
    EXPECT_FALSE(bootstrap(r, BootstrapKind::circular_block));
    r.starts[3] = r.starts[2];
    EXPECT_THROW(bootstrap(r, BootstrapKind::naive), Error);
    EXPECT_THROW(bootstrap(constant_in_blocks({1, 2}, 2, {1, 1}), BootstrapKind::naive, {0}),
                 Error);
}

Direction two_entrants() {
    Direction d;
    d.held_out = "air";
    std::mt19937 random(5);
    std::uniform_real_distribution<double> value(0.5, 1);
    for (const char* name : {"persistence", "good", "bad"}) {
        EntrantScores s;
        s.name = name;
        s.foreground = ErrorTable(300, 2);
        for (double& v : s.foreground.values) {
            v = value(random) * (s.name == "good" ? 0.5 : s.name == "bad" ? 2 : 1);
        }
        d.entrants.push_back(s);
    }
    d.starts.resize(300);
    std::iota(d.starts.begin(), d.starts.end(), 0);
    return d;
}

TEST(Bootstrap, DifferencesArePairedAndHaveTheRightSign) {
    const Direction d = two_entrants();
    const WindowRatios good = gain_ratios(d, d.entrant("good")),
                       bad = gain_ratios(d, d.entrant("bad")),
                       both = difference_ratios(d, d.entrant("good"), d.entrant("bad"));
    EXPECT_NEAR(ratio(good), gain(d, d.entrant("good")), 1e-12);
    EXPECT_NEAR(ratio(both), ratio(good) - ratio(bad), 1e-12);
    const auto interval = bootstrap(both, BootstrapKind::block, {10000, 0, 0.95, 50});
    EXPECT_GT(interval->low, 1);
    const auto nothing =
        bootstrap(difference_ratios(d, d.entrants[1], d.entrants[1]), BootstrapKind::naive);
    EXPECT_EQ(nothing->low, 0);
    EXPECT_EQ(nothing->high, 0);
    EXPECT_THROW(d.entrant("ugly"), Error);
}

TEST(Bootstrap, TheSameSeedGivesTheSameIntervalOnEveryMachine) {
    const Direction d = two_entrants();
    const WindowRatios r = gain_ratios(d, d.entrants[1]);
    for (const auto kind : {BootstrapKind::naive, BootstrapKind::circular_block}) {
        const auto a = bootstrap(r, kind, {2000, 3, 0.95, 50}),
                   b = bootstrap(r, kind, {2000, 3, 0.95, 50});
        EXPECT_EQ(a->low, b->low);
        EXPECT_EQ(a->high, b->high);
        EXPECT_NE(a->low, bootstrap(r, kind, {2000, 4, 0.95, 50})->low);
    }
}

/// 810 windows of two correlated series, like errors of overlapping windows: means over 15 samples
/// at stride 10 of an autocorrelated process, so that neighbors share most of what they see.
WindowRatios simulated(unsigned seed, double memory, double true_gain) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const double phi = std::exp(-1 / memory), kick = std::sqrt(1 - phi * phi);
    double common = normal(random), own = normal(random);
    std::vector<double> held, model;
    for (int t = 0; t < 950; ++t) {
        common = phi * common + kick * normal(random);
        own = phi * own + kick * normal(random);
        held.push_back(std::exp(0.5 * common));  // errors are positive and skewed
        model.push_back((1 - true_gain) * std::exp(0.5 * common + 0.4 * own - 0.08));
    }
    WindowRatios r;
    for (int s = 0; s < 810; ++s) {
        double p = 0, m = 0;
        for (int i = 0; i < 15; ++i) {
            p += held[std::size_t(s + 10 * i)] / 15;
            m += model[std::size_t(s + 10 * i)] / 15;
        }
        r.starts.push_back(s);
        r.over.push_back(p - m);
        r.under.push_back(p);
    }
    return r;
}

TEST(Bootstrap, ItsCoverageOnAutocorrelatedErrorsIsMeasured) {
    // E[exp(0.4 z - 0.08)] = 1, so the gain that windows without end would show is the true one.
    constexpr int kTrials = 400;
    constexpr double kGain = 0.2;
    for (const double memory : {10.0, 30.0, 100.0}) {
        for (const auto kind :
             {BootstrapKind::naive, BootstrapKind::block, BootstrapKind::circular_block}) {
            std::vector<int> inside(kTrials);
            std::vector<double> width(kTrials);
            parallel_for(kTrials, [&](int i) {
                const auto t = bootstrap(simulated(unsigned(1000 + i), memory, kGain), kind,
                                         {400, 0, 0.95, 140});
                inside[std::size_t(i)] = t->low <= kGain && kGain <= t->high;
                width[std::size_t(i)] = t->high - t->low;
            });
            const double covered =
                double(std::accumulate(inside.begin(), inside.end(), 0)) / kTrials;
            std::printf(
                "coverage of nominal 95 %%, memory %3.0f samples, %-14s: %.1f %%, width %.3f\n",
                memory, to_string(kind).c_str(), 100 * covered,
                std::accumulate(width.begin(), width.end(), 0.0) / kTrials);
            if (kind == BootstrapKind::naive) {
                EXPECT_LT(covered, 0.3);  // what the paper warns of
            } else {
                EXPECT_GT(covered, 0.45);
                EXPECT_LT(covered, 0.96);  // six blocks stay anti-conservative
            }
        }
    }
}

}  // namespace
}  // namespace verdigris
