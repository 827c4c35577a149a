// SPDX-License-Identifier: MIT
#include "verdigris/forecast/choose.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/forecast/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

/// The color goes out for `turn` frames and comes back.
Context reversing(int n, double turn, double sigma, unsigned seed) {
    std::mt19937 random(seed);
    Context context;
    const AffineDrift d = planted_drift();
    for (int t = 0; t < n; ++t) {
        const double phase = t <= turn ? t : 2 * turn - t;
        context.frames.push_back(
            paint(48, 40, [&](int x, int y) { return apply(d, texture(x, y), phase); }));
        add_noise(context.frames.back(), sigma, random);
    }
    context.sigma = sigma;
    context.tau = 2.4 * sigma;
    return context;
}

TEST(BackTested, PicksTheDriftThatIsThere) {
    for (int n : {5, 6, 10}) {
        const Context context = drifting(n, planted_drift(), 0.001, 2);
        const Forecast f = back_tested().forecast(context);
        EXPECT_EQ(f.forecaster.rfind("affinergb", 0), 0u) << n << ": " << f.explanation;
        EXPECT_NE(f.explanation.find("better than holding still"), std::string::npos);
        EXPECT_EQ(f.context_length, n);
        EXPECT_GT(largest_difference(f.at(5), f.at(0)), 0.01);
    }
}

TEST(BackTested, QuotesTheEvidence) {
    const Forecast f = back_tested().forecast(drifting(10, planted_drift(), 0.001, 2));
    EXPECT_NE(f.explanation.find("the last 5 frames"), std::string::npos) << f.explanation;
    const auto rows = backtest(drifting(10, planted_drift(), 0.001, 2));
    ASSERT_EQ(rows.size(), 7u);
    EXPECT_EQ(rows[0].forecaster, "persistence");
    EXPECT_EQ(rows[0].gain_over_persistence, 0);
    EXPECT_EQ(rows[0].frames_predicted, 5);
    EXPECT_GT(rows[1].gain_over_persistence, 0.5);
    EXPECT_NEAR(rows[1].gain_over_persistence,
                1 - rows[1].mean_squared_error / rows[0].mean_squared_error, 1e-12);
}

TEST(BackTested, HoldsStillOnPureNoise) {
    int held = 0, textured = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        for (int n : {5, 10}) {
            held +=
                back_tested().forecast(drifting(n, {}, 0.005, seed)).forecaster == "persistence";
            // No contrast but noise: shrinking the noise of the last frame must earn nothing, with
            // or without the ridge.
            Context flat = drifting(n, {}, 0);
            std::mt19937 random(seed);
            for (auto& f : flat.frames) {
                for (SrgbF& c : f.pixels()) c = {0.5f, 0.4f, 0.3f};
                add_noise(f, 0.005, random);
            }
            flat.sigma = 0.005;
            ChooseOptions paper;
            paper.ridge_k = 0;
            textured += back_tested(paper).forecast(flat).forecaster == "persistence";
        }
    }
    EXPECT_EQ(held, 40);
    EXPECT_GE(textured, 38);
}

TEST(BackTested, DoesNotFollowWhatItsContextRefutes) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        for (const auto& [n, turn] :
             {std::pair{10, 6.0}, std::pair{10, 5.0}, std::pair{5, 2.5}, std::pair{6, 3.0}}) {
            const Forecast f = back_tested().forecast(reversing(n, turn, 0.001, seed));
            EXPECT_EQ(f.forecaster, "persistence") << n << " " << turn << ": " << f.explanation;
            EXPECT_NE(f.explanation.find("the last observed state is held"), std::string::npos);
        }
    }
}

TEST(BackTested, NothingChangesNothingIsForecast) {
    const Forecast f = back_tested().forecast(drifting(8, {}));
    EXPECT_EQ(f.forecaster, "persistence");
}

TEST(BackTested, SaysWhenThereIsTooLittle) {
    for (int n : {1, 2, 4}) {
        const Forecast f = back_tested().forecast(drifting(n, planted_drift()));
        EXPECT_EQ(f.forecaster, "persistence");
        EXPECT_NE(f.explanation.find("nothing to hold back"), std::string::npos) << f.explanation;
    }
    EXPECT_TRUE(backtest(drifting(4, planted_drift())).empty());
}

TEST(BackTested, JudgesTheSpecimenOnly) {
    Context context = drifting(8, planted_drift(), 0.001, 4);
    context.specimen = Mask(48, 40);  // the specimen rests, the backdrop drifts
    for (int y = 10; y < 30; ++y) {
        for (int x = 10; x < 30; ++x) {
            context.specimen(x, y) = kInside;
            for (std::size_t i = 1; i < context.frames.size(); ++i) {
                context.frames[i](x, y) = context.frames[0](x, y);
            }
        }
    }
    EXPECT_EQ(back_tested().forecast(context).forecaster, "persistence");
}

TEST(BackTested, SameAnswerOnAnyNumberOfThreads) {
    const Context context = drifting(9, planted_drift(), 0.002, 8, 90, 70);
    set_thread_count(1);
    const auto one = backtest(context);
    set_thread_count(0);
    const auto all = backtest(context);
    ASSERT_EQ(one.size(), all.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].mean_squared_error, all[i].mean_squared_error);
    }
}

TEST(Automatic, IsBandtrendUnderItsOwnName) {
    const Context context = drifting(6, planted_drift(), 0.001, 2);
    const Forecaster best = forecaster_by_name("auto");
    EXPECT_EQ(best.name, "auto");
    const Forecast a = best.forecast(context),
                   b = forecaster_by_name("bandtrend").forecast(context);
    EXPECT_EQ(a.forecaster, "bandtrend");
    EXPECT_EQ(largest_difference(a.at(7), b.at(7)), 0);
}

TEST(ForecasterByName, KnowsAllItsNames) {
    const Context context = drifting(8, planted_drift(), 0.001);
    for (const std::string& name : forecaster_names()) {
        EXPECT_FALSE(forecaster_by_name(name).forecast(context).forecaster.empty()) << name;
    }
    EXPECT_EQ(forecaster_by_name("affinergb").name, "affinergb full order 1");
    EXPECT_EQ(forecaster_by_name("affinergb-per-channel-2").name, "affinergb per-channel order 2");
    try {
        forecaster_by_name("afinergb");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::usage);
        EXPECT_NE(std::string(e.what()).find("affinergb-single-gain-1"), std::string::npos);
    }
}

}  // namespace
}  // namespace verdigris
