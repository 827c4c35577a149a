// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_trend.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>

#include "verdigris/error.h"
#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/forecast/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kSide = 64;

/// A plate on a backdrop: frame t of a scene that goes on for ever, without noise.
Image<SrgbF> plate(double change, double light = 1) {
    return paint(kSide, kSide, [&](int x, int y) {
        const bool specimen = x >= 16 && y >= 8 && y < 56;
        SrgbF c = specimen ? texture(x, y) : SrgbF{0.5f, 0.5f, 0.52f};
        if (specimen) {
            const double local = change * (1 + 0.5 * std::sin(x * 0.2) * std::cos(y * 0.15));
            c = {float(c.r - 0.010 * local), float(c.g - 0.006 * local),
                 float(c.b - 0.002 * local)};
        }
        // As good as linear light for factors near 1.
        const float f = float(std::pow(light, 1 / 2.2));
        return SrgbF{c.r * f, c.g * f, c.b * f};
    });
}

Mask plate_mask() {
    Mask mask(kSide, kSide);
    for (int y = 8; y < 56; ++y)
        for (int x = 16; x < kSide; ++x) mask(x, y) = kInside;
    return mask;
}

Context seen(const Scene& scene, int n, double sigma = 0.003, unsigned seed = 1) {
    return seen_through_noise(scene, n, plate_mask(), sigma, seed);
}

/// Sums of squared errors over the specimen and units 1 to 10.
struct Errors {
    double ours = 0, still = 0;
};
Errors errors_of(const Scene& scene, const Context& context,
                 const Forecaster& forecaster = band_trend()) {
    const Forecast f = forecaster.forecast(context);
    const Mask where = plate_mask();
    auto [ours, still] = Errors{};
    for (int k = 1; k <= 10; ++k) {
        const Image<SrgbF> truth = scene(context.length() - 1 + k), frame = f.at(k);
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                if (where(x, y) == 0) continue;
                const auto square = [](SrgbF a, SrgbF b) {
                    const double r = double(a.r - b.r), g = double(a.g - b.g),
                                 c = double(a.b - b.b);
                    return r * r + g * g + c * c;
                };
                ours += square(frame(x, y), truth(x, y));
                still += square(context.frames.back()(x, y), truth(x, y));
            }
        }
    }
    return {ours, still};
}
double relative_error(const Scene& scene, const Context& context,
                      const Forecaster& forecaster = band_trend()) {
    const Errors e = errors_of(scene, context, forecaster);
    return e.ours / e.still;
}

TEST(BandTrend, CarriesOnALocalDrift) {
    for (const int n : {5, 10}) {
        const Scene scene = [](int t) { return plate(t); };
        EXPECT_LT(relative_error(scene, seen(scene, n)), 0.1) << n;
    }
}

TEST(BandTrend, SlowsDownWithTheSpecimen) {
    const Scene scene = [](int t) { return plate(8 * std::sqrt(1 + t)); };
    const Context context = seen(scene, 5);
    EXPECT_LT(relative_error(scene, context), 0.25);
    EXPECT_LT(relative_error(scene, context), 0.2 * relative_error(scene, context, affinergb()));
}

TEST(BandTrend, HoldsAStillSceneAndTakesNoiseBack) {
    const Scene scene = [](int) { return plate(0); };
    for (const int n : {5, 10})
        for (const unsigned seed : {1u, 2u, 3u})
            EXPECT_LT(relative_error(scene, seen(scene, n, 0.003, seed)), 0.95) << n << seed;
}

TEST(BandTrend, LightThatTheBackdropShowsIsNotAging) {
    const double light[] = {1, 1.03, 0.98, 1.05, 1.08, 1.12};
    const Scene scene = [&](int t) { return plate(t, light[std::min(t, 5)]); };
    EXPECT_LT(relative_error(scene, seen(scene, 6)), 0.2);
}

TEST(BandTrend, OneGainOfTheWholePictureAndNothingElseIsLight) {
    const double light[] = {1, 1.02, 1.04, 1.05, 1.07, 1.08};
    const Scene lit = [&](int t) { return plate(0, light[std::min(t, 5)]); };
    Context context = seen(lit, 6);
    context.specimen = {};
    const auto gains = backdrop_light(context);
    EXPECT_NEAR(gains[0][1], 1.08, 0.003);
    EXPECT_LT(relative_error(lit, context), 1);
    // With any aging in it, or in color, it may be the copper.
    const Scene aging = [&](int t) { return plate(t, light[std::min(t, 5)]); };
    context = seen(aging, 6);
    context.specimen = {};
    EXPECT_EQ(backdrop_light(context)[0], (std::array<double, 3>{1, 1, 1}));
    context = seen(lit, 6);
    context.specimen = {};
    for (std::size_t i = 0; i < context.frames.size(); ++i)
        for (SrgbF& c : context.frames[i].pixels()) c.b *= 1 - 0.01f * float(i);
    EXPECT_EQ(backdrop_light(context)[0], (std::array<double, 3>{1, 1, 1}));
}

TEST(BandTrend, FlickerIsToldFromAgingWithoutABackdrop) {
    for (const int n : {5, 10}) {
        // Sums: where the last frame's light is the usual one, holding still is nearly perfect.
        double with = 0, without = 0, still = 0;
        for (unsigned seed = 1; seed <= 24; ++seed) {
            std::mt19937 random(seed);
            std::normal_distribution<double> flicker(0, 0.03);
            std::vector<double> light;
            for (int t = 0; t < n; ++t) light.push_back(std::exp(flicker(random)));
            const Scene scene = [&](int t) {
                return plate(0.3 * t, t < n ? light[std::size_t(t)] : 1);
            };
            Context context = seen(scene, n, 0.003, seed);
            context.backdrop = Mask(kSide, kSide);  // none of it in sight
            const Errors e = errors_of(scene, context);
            with += e.ours;
            still += e.still;
            without +=
                errors_of(scene, context, band_trend({.design = band_trend_design(":gray=0")}))
                    .ours;
        }
        EXPECT_LT(with, 0.97 * still) << n;
        EXPECT_LT(with, 0.93 * without) << n;
    }
}

TEST(BandTrend, NeverMuchWorseThanHoldingStill) {
    const auto still = [] { return plate(0); };
    // A light is switched on; the tripod moves; a hand; a flash. The specimen does not change.
    const auto moved = [&] {
        const Image<SrgbF> from = still();
        return paint(kSide, kSide,
                     [&](int x, int y) { return from(std::min(x + 3, kSide - 1), y); });
    };
    const auto hand = [&] {
        Image<SrgbF> frame = still();
        for (int y = 20; y < 40; ++y)
            for (int x = 20; x < 50; ++x) frame(x, y) = {0.1f, 0.08f, 0.06f};
        return frame;
    };
    for (const int n : {5, 10}) {
        for (int at = 1; at < n; ++at) {
            const Scene scenes[] = {
                [&](int t) { return plate(0, t < at ? 1 : 1.2); },
                [&](int t) { return t < at ? still() : moved(); },
                [&](int t) { return t == at && at < n - 1 ? hand() : still(); },
                [&](int t) { return plate(0, t == at && at < n - 1 ? 1.5 : 1); },
            };
            for (std::size_t i = 0; i < std::size(scenes); ++i) {
                EXPECT_LT(relative_error(scenes[i], seen(scenes[i], n)), 1.02)
                    << "scene " << i << " at " << at << " of " << n;
            }
        }
    }
}

/// The error without a part over that with it.
double worth(const Scene& scene, const Context& context, const std::string& without) {
    const Forecaster less = band_trend({.design = band_trend_design(without)});
    return relative_error(scene, context, less) / relative_error(scene, context);
}

TEST(BandTrend, EachPartIsWhatItsOwnSceneNeeds) {
    const Scene local = [](int t) { return plate(t); };
    EXPECT_GT(worth(local, seen(local, 5), ":local=0"), 1.5);
    EXPECT_GT(worth(local, seen(local, 5), ":bands=0"), 1.02);
    const Scene slowing = [](int t) { return plate(8 * std::sqrt(1 + t)); };
    EXPECT_GT(worth(slowing, seen(slowing, 5), ":slowing=0"), 1.05);
    const double light[] = {1, 1.03, 0.98, 1.05, 1.08, 1.12};
    const Scene lit = [&](int t) { return plate(t, light[std::min(t, 5)]); };
    EXPECT_GT(worth(lit, seen(lit, 6), ":light=0"), 3);
    const double flicker[] = {1, 1.03, 0.98, 1.02, 0.98, 1.03};
    const Scene flickering = [&](int t) { return plate(0, t < 6 ? flicker[t] : 1); };
    EXPECT_GT(worth(flickering, seen(flickering, 6), ":relight=0"), 1.5);
    const Scene still = [](int) { return plate(0); };
    EXPECT_GT(worth(still, seen(still, 5), ":noise=0"), 1.01);
    Context hand = seen(local, 6);
    for (SrgbF& c : hand.frames[3].pixels()) c = {c.r * 0.7f, c.g * 0.7f, c.b * 0.7f};
    hand.specimen = {};  // no backdrop: the step cannot be told from light
    EXPECT_GT(worth(local, hand, ":events=0"), 1.5);
    EXPECT_EQ(worth(local, seen(local, 5), ""), 1);
}

TEST(BandTrend, ContrastAndMeanColorHaveEachTheirFuture) {
    // Contrast dies away, and all of it goes on to get darker.
    const Scene fading = [](int t) {
        Image<SrgbF> frame = plate(0);
        const float contrast = std::exp(-0.3f * float(t));
        for (SrgbF& c : frame.pixels()) {
            const auto of = [&](float v) {
                return 0.5f - 0.01f * float(t) + contrast * (v - 0.5f);
            };
            c = {of(c.r), of(c.g), of(c.b)};
        }
        return frame;
    };
    Context faded = seen(fading, 6);
    faded.backdrop = {};
    faded.specimen = {};
    const std::string plain = ":gray=0", joint = ":gray=0:split=0";
    EXPECT_GT(worth(fading, faded, joint), 1.1 * worth(fading, faded, plain));
}

TEST(BandTrend, SaysWhichFrameDoesNotCount) {
    const Scene scene = [](int t) {
        Image<SrgbF> frame = plate(0.3 * t);
        if (t == 2)
            for (SrgbF& c : frame.pixels()) c = {0.1f, 0.08f, 0.06f};
        return frame;
    };
    Context context = seen(scene, 6);
    context.specimen = Mask();  // without a backdrop nothing else takes the dark away
    EXPECT_NE(
        band_trend().forecast(context).explanation.find("Frame 3 of 6 is unlike its neighbors"),
        std::string::npos)
        << band_trend().forecast(context).explanation;
}

TEST(BandTrend, TellsHowItDidOnTheEndOfTheContext) {
    const Scene scene = [](int t) { return plate(t); };
    EXPECT_NE(
        band_trend().forecast(seen(scene, 6)).explanation.find("better than by holding still"),
        std::string::npos);
    EXPECT_EQ(band_trend({.explain = false}).forecast(seen(scene, 6)).explanation, "");
}

TEST(BandTrend, TellsNoiseTakenBackFromForesight) {
    const auto said = [](double pace, double sigma) {
        const Scene scene = [pace](int t) { return plate(pace * t); };
        return band_trend().forecast(seen(scene, 10, sigma)).explanation;
    };
    EXPECT_NE(said(0, 0.01).find("nearly all of it by taking back the noise"), std::string::npos)
        << said(0, 0.01);
    EXPECT_NE(said(0.5, 0.01).find("points of it by taking back the noise"), std::string::npos)
        << said(0.5, 0.01);
    EXPECT_EQ(said(1, 0.001).find("noise"), std::string::npos) << said(1, 0.001);
}

TEST(BandTrend, ItsIntervalsHoldOnItsOwnKindOfScene) {
    // A drift that bends slowly, and noise: over seeds, as often inside as they say.
    double inside80 = 0, inside95 = 0, all = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        std::mt19937 random(100 + seed);
        const double bend = std::uniform_real_distribution<double>(-0.02, 0.01)(random);
        const Scene scene = [&](int t) { return plate(t + bend * t * t); };
        const Context context = seen(scene, 7, 0.003, seed);
        const Forecast f = band_trend().forecast(context);
        ASSERT_TRUE(f.spread.known());
        std::mt19937 noise(200 + seed);
        for (int k = 1; k <= 10; ++k) {
            Image<SrgbF> truth = scene(6 + k), sd;
            add_noise(truth, 0.003, noise);
            const Image<SrgbF> frame = f.at(k);
            spread_image(f.spread, k, sd);
            for (std::size_t i = 0; i < sd.pixel_count(); ++i) {
                const double s = double(sd.pixels()[i].g);
                if (!(s > 0)) continue;
                const double off =
                    std::abs(double(frame.pixels()[i].g) - double(truth.pixels()[i].g));
                inside80 += off <= kHalfWidth80 * s;
                inside95 += off <= kHalfWidth95 * s;
                ++all;
            }
        }
    }
    EXPECT_NEAR(inside80 / all, 0.80, 0.10);
    EXPECT_NEAR(inside95 / all, 0.95, 0.04);
}

TEST(BandTrend, HoldsFromWhereItIsNotSureAndSaysSo) {
    // A drift that wanders: it cannot be known for long.
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::vector<double> level{0};
    for (int t = 1; t < 12; ++t) level.push_back(level.back() + 0.3 + normal(random));
    const Context context = seen([&](int t) { return plate(level[std::size_t(t)]); }, 10, 0.001, 3);
    const Forecast f = band_trend().forecast(context);
    ASSERT_TRUE(f.trajectory.law.tabulated());
    const double last = f.trajectory.law.nodes.back().horizon;
    ASSERT_LT(last, 100);
    EXPECT_NE(f.explanation.find(fmt::format("Beyond +{:.0f} the trend is held", last)),
              std::string::npos)
        << f.explanation;
    EXPECT_EQ(largest_difference(f.at(last), f.at(last + 30)), 0);
    // It is less sure of what it holds than of what it follows.
    EXPECT_GT(f.spread.at(last + 30).common, f.spread.at(last).common);
}

TEST(BandTrend, StartsAtTheLastFrameAndMovesNothingElse) {
    const Scene scene = [](int t) { return plate(3 * t); };
    const Context context = seen(scene, 5);
    const Forecast f = band_trend().forecast(context);
    EXPECT_TRUE(same_bytes(f.at(0), context.frames.back()));
    const Image<SrgbF> later = f.at(50);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < 16; ++x) {
            EXPECT_EQ(std::memcmp(&later(x, y), &context.frames.back()(x, y), sizeof(SrgbF)), 0);
        }
    }
    for (const SrgbF& c : later.pixels())
        EXPECT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.g <= 1 && c.b >= 0 && c.b <= 1);
}

TEST(BandTrend, ABackdropThatIsKnownIsHeldThoughAllIsForecast) {
    const Scene scene = [](int t) { return plate(t, 1 + 0.02 * t); };
    Context context = seen(scene, 5);
    context.backdrop = plate_mask();
    for (auto& v : context.backdrop.pixels()) v = v ? 0 : kInside;
    context.specimen = Mask();
    const Image<SrgbF> later = band_trend().forecast(context).at(10);
    EXPECT_EQ(std::memcmp(&later(3, 3), &context.frames.back()(3, 3), sizeof(SrgbF)), 0);
    EXPECT_LT(later(40, 30).r, context.frames.back()(40, 30).r - 0.02f);
}

TEST(BandTrend, SameBytesAtAnyNumberOfThreads) {
    const Scene scene = [](int t) { return plate(t); };
    const Context context = seen(scene, 6);
    set_thread_count(1);
    const Forecast one = band_trend().forecast(context);
    set_thread_count(0);
    const Forecast all = band_trend().forecast(context);
    EXPECT_TRUE(same_bytes(one.at(7.5), all.at(7.5)));
}

TEST(BandTrend, WhatCannotMoveIsHeld) {
    const Scene scene = [](int) { return plate(0); };
    Context same = seen(scene, 5, 0);
    EXPECT_EQ(band_trend().forecast(same).trajectory.law.order, 0);
    Context one = seen(scene, 1);
    EXPECT_EQ(band_trend().forecast(one).trajectory.law.order, 0);
    Context two = seen(scene, 2);
    EXPECT_TRUE(std::isfinite(band_trend().forecast(two).at(100)(30, 30).r));
    Context no_pixel = seen(scene, 5);
    no_pixel.clipped = Mask(kSide, kSide);
    for (auto& v : no_pixel.clipped.pixels()) v = kInside;
    const Forecast f = band_trend().forecast(no_pixel);
    EXPECT_TRUE(same_bytes(f.at(20), no_pixel.frames.back()));
    EXPECT_FALSE(f.explanation.empty());
}

TEST(BandTrend, ALongContextCountsFromItsEnd) {
    const Scene scene = [](int t) { return plate(0.1 * t); };
    const Context context = seen(scene, 60);
    const Forecast f = band_trend().forecast(context);
    EXPECT_EQ(f.context_length, 60);
    EXPECT_LT(relative_error(scene, context), 0.5);
}

}  // namespace
}  // namespace verdigris
