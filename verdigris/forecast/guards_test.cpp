// SPDX-License-Identifier: MIT
#include "verdigris/forecast/guards.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/forecast/affine.h"
#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

const Status* find(const Statuses& all, const std::string& id) {
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const Status& s) { return s.id == id; });
    return at == all.end() ? nullptr : &*at;
}

Statuses guards_of(const Context& context, const std::vector<double>& horizons = {5}) {
    return check_guards(context, affinergb().forecast(context), horizons);
}

TEST(Guards, AreSilentOnAGoodContext) {
    EXPECT_TRUE(guards_of(drifting(10, planted_drift(), 0.002), {5, 10, 20}).empty());
}

TEST(Guards, FewFramesIsARefusal) {
    const Statuses guards = guards_of(drifting(3, planted_drift(), 0.001));
    const Status* few = find(guards, "few_frames");
    ASSERT_NE(few, nullptr);
    EXPECT_EQ(few->severity, Severity::refusal);
    EXPECT_EQ(few->sentence,
              "The context has only 3 frames; below 5 the fit is worse than doing nothing. Raise "
              "--context or record more; --force goes on all the same.");
    try {
        refuse_if_needed(guards);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::refused);
        EXPECT_EQ(e.sentence(), few->sentence);
    }
    EXPECT_EQ(find(guards_of(drifting(5, planted_drift(), 0.001)), "few_frames"), nullptr);
    EXPECT_NO_THROW(refuse_if_needed(guards_of(drifting(5, planted_drift(), 0.001), {50})));
    EXPECT_NE(find(guards_of(drifting(1, {})), "few_frames")->sentence.find("only 1 frame;"),
              std::string::npos);
}

TEST(Guards, LongHorizonNamesTheHorizons) {
    const Context context = drifting(10, planted_drift(), 0.002);
    EXPECT_EQ(find(guards_of(context, {5, 20}), "long_horizon"), nullptr);
    const Statuses guards = guards_of(context, {5, 20.5, 50});
    const Status* long_horizon = find(guards, "long_horizon");
    ASSERT_NE(long_horizon, nullptr);
    EXPECT_EQ(long_horizon->severity, Severity::caution);
    EXPECT_EQ(long_horizon->sentence.find("+20.5, +50 lie beyond +20"), 0u)
        << long_horizon->sentence;
    EXPECT_NE(long_horizon->sentence.find("the drift was not measured"), std::string::npos);
    // What is held has no drift to speak of.
    const Statuses held = check_guards(context, persistence().forecast(context), {50});
    ASSERT_NE(find(held, "long_horizon"), nullptr);
    EXPECT_EQ(find(held, "long_horizon")->sentence.find("drift"), std::string::npos);
    EXPECT_NE(find(held, "long_horizon")->sentence.find("as it was last seen"), std::string::npos);
}

TEST(Guards, LongHorizonSaysWhereTheForecastStandsStill) {
    const Context context = drifting(10, planted_drift(), 0.002);
    Forecast f = affinergb().forecast(context);
    f.trajectory.law.nodes = {{1, 1, 0}, {15, 9, 0}};
    const Statuses guards = check_guards(context, f, {5, 50});
    ASSERT_NE(find(guards, "long_horizon"), nullptr);
    EXPECT_NE(find(guards, "long_horizon")->sentence.find("stands still from +15 on, so it shows"),
              std::string::npos)
        << find(guards, "long_horizon")->sentence;
    // Still under way at +30.
    f.trajectory.law.nodes.back().horizon = 40;
    EXPECT_NE(find(check_guards(context, f, {30, 50}), "long_horizon")->sentence.find("direction"),
              std::string::npos);
}

TEST(Guards, ColorReversalNamesTheChannel) {
    Context context;
    std::mt19937 random(1);
    for (int t = 0; t < 10; ++t) {
        context.frames.push_back(paint(48, 40, [t](int x, int y) {
            SrgbF c = texture(x, y);
            c.g += 0.01f * float(t <= 5 ? t : 10 - t);
            c.r -= 0.01f * float(t);
            return c;
        }));
        add_noise(context.frames.back(), 0.002, random);
    }
    context.sigma = 0.002;
    context.tau = 0.0048;
    const Statuses guards = guards_of(context);
    const Status* reversal = find(guards, "color_reversal");
    ASSERT_NE(reversal, nullptr);
    EXPECT_EQ(reversal->severity, Severity::caution);
    EXPECT_NE(reversal->sentence.find("green rose until about frame 6 of 10 and then fell again"),
              std::string::npos)
        << reversal->sentence;
    EXPECT_EQ(reversal->sentence.find("red"), std::string::npos);
}

TEST(Guards, OutOfGamutTellsTheShareAndWhetherItWasHeld) {
    Context context;
    for (int t = 0; t < 6; ++t) {
        context.frames.push_back(paint(50, 40, [t](int x, int y) {
            const SrgbF c = texture(x, y);
            return SrgbF{c.r, c.g, c.b - 0.02f * float(t)};
        }));
    }
    context.tau = 5e-4;
    const Forecast held = affinergb().forecast(context);
    const Statuses clamped = check_guards(context, held, {1, 10});
    const Status* found = find(clamped, "out_of_gamut");
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->severity, Severity::caution);
    EXPECT_NE(found->sentence.find("at +10"), std::string::npos) << found->sentence;
    EXPECT_NE(found->sentence.find("frozen"), std::string::npos);
    AffineOptions loose;
    loose.clamp = false;
    const Statuses free = check_guards(context, affinergb(loose).forecast(context), {10});
    EXPECT_NE(find(free, "out_of_gamut")->sentence.find("cut off"), std::string::npos);
    EXPECT_EQ(find(check_guards(context, held, {0}), "out_of_gamut"), nullptr);
}

TEST(Guards, MostlyClippedCountsTheSpecimen) {
    Context context = drifting(6, planted_drift(), 0.001);
    context.specimen = Mask(48, 40);
    context.clipped = Mask(48, 40);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 20; ++x) context.specimen(x, y) = kInside;
        for (int x = 0; x < 3; ++x) context.clipped(x, y) = kInside;  // 15 %
    }
    EXPECT_EQ(find(guards_of(context), "mostly_clipped"), nullptr);
    for (int y = 0; y < 40; ++y) context.clipped(3, y) = context.clipped(4, y) = kInside;
    const Statuses guards = guards_of(context);
    ASSERT_NE(find(guards, "mostly_clipped"), nullptr);
    EXPECT_EQ(find(guards, "mostly_clipped")->sentence.find("25 % of the specimen"), 0u);
}

TEST(Guards, NoChangeIsInformation) {
    for (int n : {5, 10}) {
        const Statuses guards = guards_of(drifting(n, {}, 0.003, 4, 100, 100));
        ASSERT_NE(find(guards, "no_change"), nullptr) << n;
        EXPECT_EQ(find(guards, "no_change")->severity, Severity::info);
    }
    // A twentieth of the specimen that changes is a change.
    Context spot = drifting(8, {}, 0.003, 4, 100, 100);
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 5; ++x) spot.frames.back()(x, y).g += 0.1f;
    }
    EXPECT_EQ(find(guards_of(spot), "no_change"), nullptr);
}

Context with_backdrop(int jump_at, double gain_specimen, double gain_backdrop) {
    Context context = drifting(8, planted_drift(), 0.001, 4);
    context.specimen = Mask(48, 40);
    for (int y = 5; y < 35; ++y) {
        for (int x = 5; x < 35; ++x) context.specimen(x, y) = kInside;
    }
    for (int t = 0; t < 8; ++t) {
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < 48; ++x) {
                SrgbF& c = context.frames[std::size_t(t)](x, y);
                const bool metal = context.specimen(x, y) != 0;
                if (!metal) c = texture(x, y);
                const float g = t < jump_at ? 1 : float(metal ? gain_specimen : gain_backdrop);
                c = {c.r * g, c.g * g, c.b * g};
            }
        }
    }
    return context;
}

TEST(Guards, ExposureJumpNeedsBothToMove) {
    const Statuses guards = guards_of(with_backdrop(3, 1.06, 1.06));
    const Status* jump = find(guards, "exposure_jump");
    ASSERT_NE(jump, nullptr);
    EXPECT_EQ(jump->severity, Severity::caution);
    EXPECT_EQ(jump->sentence.find("Between frames 3 and 4 of 8 specimen and backdrop got 6.0 % "
                                  "brighter together"),
              0u)
        << jump->sentence;
    EXPECT_NE(
        find(guards_of(with_backdrop(6, 0.94, 0.94)), "exposure_jump")->sentence.find("darker"),
        std::string::npos);
    EXPECT_EQ(find(guards_of(with_backdrop(3, 1.06, 1)), "exposure_jump"), nullptr);
    EXPECT_EQ(find(guards_of(with_backdrop(3, 1, 1.06)), "exposure_jump"), nullptr);
    EXPECT_EQ(find(guards_of(with_backdrop(3, 1, 1)), "exposure_jump"), nullptr);
}

// The lamp of the backdrop and of the specimen gets brighter by these shares from frame to frame.
Context ramped(double specimen, double backdrop, double noise = 0.001, int frames = 10) {
    Context context = drifting(frames, {}, noise, 4);
    context.specimen = Mask(48, 40);
    for (int y = 5; y < 35; ++y) {
        for (int x = 5; x < 35; ++x) context.specimen(x, y) = kInside;
    }
    for (int t = 0; t < frames; ++t) {
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < 48; ++x) {
                const float g =
                    1 + float(t) * float(context.specimen(x, y) != 0 ? specimen : backdrop);
                SrgbF& c = context.frames[std::size_t(t)](x, y);
                c = {c.r * g, c.g * g, c.b * g};
            }
        }
    }
    return context;
}

TEST(Guards, LightRampSaysThatTheBackdropMovesToo) {
    const Statuses guards = guards_of(ramped(0.004, 0.004));
    const Status* ramp = find(guards, "light_ramp");
    ASSERT_NE(ramp, nullptr);
    EXPECT_EQ(ramp->severity, Severity::caution);
    EXPECT_NE(ramp->sentence.find("the backdrop moves with the specimen: it gets 3.6 % brighter, "
                                  "the specimen 3.6 %"),
              std::string::npos)
        << ramp->sentence;
    EXPECT_NE(ramp->sentence.find("the light, not the copper"), std::string::npos);
    EXPECT_NE(find(guards_of(ramped(-0.006, -0.004)), "light_ramp")->sentence.find("darker"),
              std::string::npos);
    // Aging alone, a backdrop that moves alone or the other way, and flicker are no ramp.
    EXPECT_EQ(find(guards_of(ramped(-0.01, 0)), "light_ramp"), nullptr);
    EXPECT_EQ(find(guards_of(ramped(-0.02, -0.004)), "light_ramp"), nullptr);
    EXPECT_EQ(find(guards_of(ramped(-0.01, 0.004)), "light_ramp"), nullptr);
    Context flicker = ramped(0, 0);
    for (std::size_t t = 0; t < 10; ++t) {
        for (SrgbF& c : flicker.frames[t].pixels()) {
            const float g = t % 2 == 0 ? 1.006f : 0.994f;
            c = {c.r * g, c.g * g, c.b * g};
        }
    }
    EXPECT_EQ(find(guards_of(flicker), "light_ramp"), nullptr);
    // A step is told as a step.
    EXPECT_EQ(find(guards_of(with_backdrop(3, 1.06, 1.06)), "light_ramp"), nullptr);
}

TEST(Guards, WorkOnANetworksFrames) {
    const Context context = drifting(6, planted_drift(), 0.001);
    Forecast network;
    network.stack.base = context.frames.back().clone();
    network.stack.horizons = {10};
    network.stack.frames.push_back(paint(48, 40, [](int, int) { return SrgbF{1.2f, 0.5f, 0.5f}; }));
    const Statuses guards = check_guards(context, network, {10});
    ASSERT_NE(find(guards, "out_of_gamut"), nullptr);
    EXPECT_NE(find(guards, "out_of_gamut")->sentence.find("100 % of the specimen at +10"),
              std::string::npos);
}

}  // namespace
}  // namespace verdigris
