// SPDX-License-Identifier: MIT
#include "verdigris/forecast/color_reversal.h"

#include <gtest/gtest.h>

#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

constexpr double kArm = 0.002;

std::vector<double> tent(int n, double turn, double slope, double jitter, std::mt19937& random) {
    std::normal_distribution<double> noise(0, jitter);
    std::vector<double> y;
    for (int t = 0; t < n; ++t) {
        y.push_back(0.4 + slope * (t <= turn ? t : 2 * turn - t) +
                    (jitter > 0 ? noise(random) : 0));
    }
    return y;
}

TEST(FindTurn, FindsAPeakAndATrough) {
    std::mt19937 random(1);
    for (int n : {5, 7, 10, 20}) {
        const double middle = (n - 1) / 2.0;
        for (double slope : {0.01, -0.01}) {
            const auto turn = find_turn(tent(n, middle, slope, 0, random), kArm);
            ASSERT_TRUE(turn) << n;
            EXPECT_EQ(turn->rises_first, slope > 0);
            EXPECT_NEAR(turn->at, middle, 0.3);
        }
        std::vector<double> parabola;
        for (int t = 0; t < n; ++t) parabola.push_back(0.5 - 0.003 * (t - middle) * (t - middle));
        const auto turn = find_turn(parabola, kArm);
        ASSERT_TRUE(turn) << n;
        EXPECT_NEAR(turn->at, middle, 1e-6);
        EXPECT_NEAR(turn->left_arm, 0.003 * middle * middle, 1e-9);
    }
}

TEST(FindTurn, FindsMostTurnsThroughJitter) {
    std::mt19937 random(2);
    int found = 0;
    for (int i = 0; i < 200; ++i)
        found += find_turn(tent(10, 4.5, 0.01, 0.002, random), kArm).has_value();
    EXPECT_GT(found, 190);
}

TEST(FindTurn, IsSilentOnJitterAlone) {
    for (int n : {5, 6, 7, 10, 20}) {
        std::mt19937 random{unsigned(n)};
        int fired = 0;
        constexpr int kRuns = 4000;
        for (int i = 0; i < kRuns; ++i) {
            fired += find_turn(tent(n, n, 0, 0.002, random), kArm).has_value();
        }
        EXPECT_LT(fired, n == 5 ? kRuns / 50 : kRuns / 100) << n;
    }
}

TEST(FindTurn, IsSilentOnMonotoneSeries) {
    for (int n : {5, 7, 10, 20}) {
        std::mt19937 random{unsigned(n)};
        int fired = 0;
        for (int i = 0; i < 2000; ++i) {
            fired += find_turn(tent(n, n, 0.005, 0.002, random), kArm).has_value();
        }
        EXPECT_LT(fired, 10) << n;
        std::vector<double> saturating;  // fast, then level: a bend, no turn
        for (int t = 0; t < n; ++t) saturating.push_back(0.4 + 0.2 * (1 - std::exp(-0.5 * t)));
        EXPECT_FALSE(find_turn(saturating, kArm)) << n;
    }
}

TEST(FindTurn, IgnoresWhatNobodyCanSee) {
    std::mt19937 random(1);
    EXPECT_FALSE(find_turn(tent(10, 4.5, 0.0001, 0, random), kArm));
    EXPECT_FALSE(find_turn(std::vector<double>(10, 0.3), kArm));
    EXPECT_FALSE(find_turn(std::vector<double>{1, 2, 3, 1}, kArm));  // too short to tell
}

Context turning_channel(int channel, double share, double sigma) {
    std::mt19937 random(6);
    Context context;
    for (int t = 0; t < 10; ++t) {
        const double phase = t <= 5 ? t : 10 - t;
        context.frames.push_back(paint(64, 64, [&](int x, int y) {
            SrgbF c = texture(x, y);
            c.r += float(0.004 * t);  // all else rises steadily
            c.g += float(0.003 * t);
            c.b += float(0.002 * t);
            if (x < share * 64) {
                float& turned = channel == 0 ? c.r : channel == 1 ? c.g : c.b;
                turned = (channel == 0   ? texture(x, y).r
                          : channel == 1 ? texture(x, y).g
                                         : texture(x, y).b) +
                         float(0.012 * phase);
            }
            return c;
        }));
        add_noise(context.frames.back(), sigma, random);
    }
    context.sigma = sigma;
    context.tau = 2.4 * sigma;
    return context;
}

TEST(FindReversals, NamesTheChannel) {
    for (int channel : {0, 1, 2}) {
        const auto found = find_reversals(turning_channel(channel, 1, 0.002));
        ASSERT_EQ(found.size(), 1u) << channel;
        EXPECT_EQ(found[0].channel, channel);
        EXPECT_TRUE(found[0].turn.rises_first);
        EXPECT_NEAR(found[0].turn.at, 5, 0.7);
        EXPECT_GT(found[0].share, 0.9);
    }
}

TEST(FindReversals, SeesATurnThatTheMeanHides) {
    const auto found = find_reversals(turning_channel(1, 0.4, 0.002));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].channel, 1);
    EXPECT_NEAR(found[0].share, 0.4, 0.08);
}

TEST(FindReversals, LooksAtTheSpecimenOnly) {
    Context context = turning_channel(1, 0.5, 0.002);
    context.specimen = Mask(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 36; x < 64; ++x) context.specimen(x, y) = kInside;
    }
    EXPECT_TRUE(find_reversals(context).empty());
}

TEST(FindReversals, IsSilentOnCommonJitter) {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        Context context = drifting(10, {}, 0.001, seed);
        std::mt19937 random(seed);
        std::normal_distribution<float> jitter(0, 0.002f);
        for (auto& frame : context.frames) {
            const float r = jitter(random), g = jitter(random), b = jitter(random);
            for (SrgbF& c : frame.pixels()) c = {c.r + r, c.g + g, c.b + b};
        }
        EXPECT_TRUE(find_reversals(context).empty()) << seed;
    }
}

TEST(FindReversals, IsSilentOnDriftWithNoise) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        EXPECT_TRUE(find_reversals(drifting(10, planted_drift(), 0.003, seed)).empty());
        EXPECT_TRUE(find_reversals(drifting(5, planted_drift(), 0.003, seed)).empty());
        EXPECT_TRUE(find_reversals(drifting(10, {}, 0.003, seed)).empty());
    }
}

}  // namespace
}  // namespace verdigris
