// SPDX-License-Identifier: MIT
#include "verdigris/forecast/backdrop_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "verdigris/forecast/band_trend.h"
#include "verdigris/forecast/context_noise.h"
#include "verdigris/forecast/increments.h"
#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

using namespace testing;

constexpr int kSide = 64;

/// A plate on a gray backdrop, which darkens here more than there.
Image<SrgbF> plate(double change) {
    return paint(kSide, kSide, [&](int x, int y) {
        if (x < 16 || y < 8 || y >= 56) return SrgbF{0.5f, 0.5f, 0.52f};
        const float local = float(change * (1 + 0.5 * std::sin(x * 0.2) * std::cos(y * 0.15)));
        const SrgbF c = texture(x, y);
        return SrgbF{c.r - 0.010f * local, c.g - 0.006f * local, c.b - 0.002f * local};
    });
}

Mask plate_mask() {
    Mask mask(kSide, kSide);
    for (int y = 8; y < 56; ++y)
        for (int x = 16; x < kSide; ++x) mask(x, y) = kInside;
    return mask;
}

Context seen(const Scene& scene, int n, double sigma) {
    return seen_through_noise(scene, n, plate_mask(), sigma);
}

TEST(BackdropLight, IsNotSomebodyWhoStandsBeforeIt) {
    // The plate fills all but a strip; of that, somebody dark hides three quarters in two frames.
    const auto somebody = [](Image<SrgbF> frame) {
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 16; ++x) frame(x, y) = {0.1f, 0.1f, 0.3f};
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 60; ++x) frame(x, y) = {0.1f, 0.1f, 0.3f};
        return frame;
    };
    for (const bool at_the_end : {false, true}) {
        Context c;
        c.specimen = plate_mask();
        for (int t = 0; t < 6; ++t) {
            const bool hidden = at_the_end ? t >= 4 : t == 1 || t == 2;
            c.frames.push_back(hidden ? somebody(plate(t)) : plate(t));
        }
        for (const auto& gain : backdrop_light(c)) EXPECT_EQ(gain[1], 1);
        // The same pictures under a light that falls: that is light.
        for (std::size_t t = 0; t < 6; ++t)
            c.frames[t] = relit(plate(double(t)), {1 - 0.1 * t, 1 - 0.1 * t, 1 - 0.1 * t});
        EXPECT_NEAR(backdrop_light(c)[0][1], 0.5, 0.01);
    }
}

TEST(BackdropLight, CountsForASpecimenAsFarAsItSharesIt) {
    // The light of the wall behind swings by a fifth; the plate, which ages, has this much of it.
    for (const double share : {0.0, 0.5, 1.0}) {
        Context c;
        c.specimen = plate_mask();
        for (int t = 0; t < 6; ++t) {
            const double swing = std::exp(0.1 * std::sin(1.3 * t)), own = std::pow(swing, share);
            Image<SrgbF> frame = relit(plate(t), {own, own, own});
            const Image<SrgbF> wall = relit(plate(0), {swing, swing, swing});
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x)
                    if (c.specimen(x, y) == 0) frame(x, y) = wall(x, y);
            c.frames.push_back(std::move(frame));
        }
        const auto light = backdrop_light(c);
        for (int t = 0; t < 5; ++t) {
            const double told = std::log(light[std::size_t(t)][1]),
                         truth = 0.1 * share * (std::sin(1.3 * 5) - std::sin(1.3 * t));
            EXPECT_NEAR(told, truth, 0.01) << share << " " << t;
        }
    }
}

TEST(BackdropLight, IsFoundThoughAMinorityMoves) {
    Context c;
    c.specimen = plate_mask();
    for (const double gain : {0.8, 1.1, 1.0}) {
        Image<SrgbF> frame = relit(plate(0), {gain, 1.02 * gain, 0.97 * gain});
        if (gain > 1)
            for (int y = 0; y < 20; ++y)
                for (int x = 0; x < 10; ++x) frame(x, y) = {0.9f, 0.1f, 0.1f};
        c.frames.push_back(std::move(frame));
    }
    const auto light = backdrop_light(c);
    EXPECT_NEAR(light[0][0], 1 / 0.8, 2e-3);
    EXPECT_NEAR(light[1][1], 1 / 1.1, 2e-3);
    EXPECT_EQ(light[2][2], 1);
    EXPECT_LT(largest_difference(relit(c.frames[0], light[0]), c.frames[2]), 1e-3);
}

// A specimen on black: nothing but noise to see the light on, and the rim that its mask leaves out.
TEST(BackdropLight, IsNotReadOffNoiseOrTheRimOfTheSpecimen) {
    const Scene on_black = [](int t) {
        Image<SrgbF> frame = plate(2 * t);
        const Mask specimen = plate_mask();
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                if (specimen(x, y) == 0) frame(x, y) = {0.02f, 0.02f, 0.02f};
        return frame;
    };
    Context c = seen(on_black, 6, 0.01);
    for (auto& frame : c.frames)
        for (SrgbF& v : frame.pixels())
            v = {std::max(v.r, 0.0f), std::max(v.g, 0.0f), std::max(v.b, 0.0f)};
    const auto is_one = [](const LightGains& light) {
        return std::ranges::all_of(light, [](const auto& gain) {
            return gain == std::array<double, 3>{1, 1, 1};
        });
    };
    EXPECT_FALSE(shows_light(c));
    EXPECT_TRUE(is_one(backdrop_light(c)));
    // A rim of a pixel is taken for backdrop: 190 pixels and more that age.
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            if (x == 16 || x == 17 || y == 8 || y == 55) c.specimen(x, y) = 0;
    EXPECT_FALSE(shows_light(c));
    EXPECT_TRUE(is_one(backdrop_light(c)));
    c.backdrop = c.specimen.clone();
    for (std::uint8_t& v : c.backdrop.pixels()) v = v ? 0 : kInside;
    EXPECT_TRUE(is_one(backdrop_light(c)));
    // So that what changes is forecast, and not taken for light.
    const Forecast f = band_trend().forecast(c);
    EXPECT_LT(mean_square_difference(f.at(5), on_black(10), plate_mask()),
              0.2 * mean_square_difference(c.frames.back(), on_black(10), plate_mask()));
}

TEST(BackdropLight, OfADimBackdropNoiseDoesNotShiftIt) {
    // Encoded 0.12 and a third of that as noise: one frame alone would choose its brighter pixels.
    const Scene dim = [](int t) {
        return paint(kSide, kSide, [&](int x, int y) {
            const bool specimen = x >= 16 && y >= 8 && y < 56;
            return specimen ? texture(x, y) : SrgbF{0.12f, 0.12f, 0.12f + 0 * float(t)};
        });
    };
    const Context c = seen(dim, 6, 0.04);
    ASSERT_TRUE(shows_light(c));
    for (const auto& gain : backdrop_light(c))
        for (const double g : gain) EXPECT_NEAR(g, 1, 0.06);
}

}  // namespace
}  // namespace verdigris
