// SPDX-License-Identifier: MIT
#include "verdigris/forecast/affine.h"

#include <gtest/gtest.h>

#include "verdigris/error.h"
#include "verdigris/forecast/context_noise.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

AffineOptions unregularized(AffineFamily family, int order = 1) {
    AffineOptions options;
    options.family = family;
    options.order = order;
    options.ridge_k = 0;
    return options;
}

void expect_drift(const AffineDrift& a, const AffineDrift& b, double tolerance) {
    for (std::size_t r = 0; r < 3; ++r) {
        EXPECT_NEAR(a.s[r], b.s[r], tolerance) << "s " << r;
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a.S[r][c], b.S[r][c], tolerance) << r << c;
    }
}

double squared_error(const Image<SrgbF>& a, const Image<SrgbF>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        const SrgbF p = a.pixels()[i], q = b.pixels()[i];
        sum += std::pow(double(p.r) - double(q.r), 2) + std::pow(double(p.g) - double(q.g), 2) +
               std::pow(double(p.b) - double(q.b), 2);
    }
    return sum / double(3 * a.pixel_count());
}

TEST(Affine, OrderZeroIsPersistenceToTheBit) {
    const Context context = drifting(7, planted_drift(), 0.01);
    const Forecast held = persistence().forecast(context);
    for (AffineFamily family :
         {AffineFamily::full, AffineFamily::per_channel, AffineFamily::single_gain}) {
        const Forecast zero = affinergb(unregularized(family, 0)).forecast(context);
        for (double h : {0.0, 1.0, 5.0, 10.0, 85.0}) {
            EXPECT_TRUE(same_bytes(zero.at(h), held.at(h))) << h;
        }
    }
}

TEST(Affine, HorizonZeroIsTheLastFrameToTheBit) {
    const Context context = drifting(6, planted_drift(), 0.01);
    for (int order : {1, 2}) {
        const Forecast f = affinergb(unregularized(AffineFamily::full, order)).forecast(context);
        EXPECT_TRUE(same_bytes(f.at(0), context.frames.back()));
    }
}

TEST(Affine, RecoversAPlantedDrift) {
    const AffineDrift planted = planted_drift();
    const AffineFit fit = fit_affine(drifting(6, planted), unregularized(AffineFamily::full));
    expect_drift(fit.linear, planted, 2e-6);  // frames are float
    EXPECT_EQ(fit.pixels, 48 * 40);
    // With noise and the default ridge it stays close, because the texture is strong.
    const AffineFit noisy = fit_affine(drifting(10, planted, 0.002));
    expect_drift(noisy.linear, planted, 2e-3);
    EXPECT_NEAR(noisy.sigma, 0.002, 2e-4);
    EXPECT_DOUBLE_EQ(noisy.lambda, 30 * noisy.sigma * noisy.sigma);
}

TEST(Affine, RecoversPlantedDriftsOfSmallerFamilies) {
    const AffineDrift diagonal{{{{-0.01, 0, 0}, {0, 0.005, 0}, {0, 0, 0.008}}},
                               {0.002, -0.003, 0.001}};
    expect_drift(fit_affine(drifting(5, diagonal), unregularized(AffineFamily::per_channel)).linear,
                 diagonal, 2e-6);
    const AffineDrift gain{{{{-0.01, 0, 0}, {0, -0.01, 0}, {0, 0, -0.01}}}, {0.002, 0.002, 0.002}};
    for (AffineFamily family :
         {AffineFamily::single_gain, AffineFamily::per_channel, AffineFamily::full}) {
        expect_drift(fit_affine(drifting(5, gain), unregularized(family)).linear, gain, 2e-6);
    }
}

TEST(Affine, ForecastsThePlantedFuture) {
    // S S = 0 and S s = 0: then the drift seen from the first frame and from the last are the same
    // and the forecast is exact.
    const AffineDrift nilpotent{{{{0.004, 0.004, 0}, {-0.004, -0.004, 0}, {0.002, 0.002, 0}}},
                                {0.003, -0.003, 0.001}};
    const Context all = drifting(25, nilpotent);
    Context seen;
    for (int i = 0; i < 8; ++i) seen.frames.push_back(all.frames[std::size_t(i)].clone());
    const Forecast exact = affinergb(unregularized(AffineFamily::full)).forecast(seen);
    for (int k : {1, 5, 12}) {
        EXPECT_LT(largest_difference(exact.at(k), all.frames[std::size_t(7 + k)]), 1e-4) << k;
    }
    // In general the error is second order in the drift.
    const Context general = drifting(20, planted_drift());
    Context half;
    for (int i = 0; i < 8; ++i) half.frames.push_back(general.frames[std::size_t(i)].clone());
    const Forecast f = affinergb(unregularized(AffineFamily::full)).forecast(half);
    EXPECT_LT(squared_error(f.at(10), general.frames[17]),
              0.02 * squared_error(half.frames.back(), general.frames[17]));
}

TEST(Affine, OrderTwoFollowsAnAcceleratingDrift) {
    Context context;
    const AffineDrift d{{}, {0.002, -0.001, 0.0005}};
    const auto frame = [&](double t) {
        return paint(48, 40,
                     [&](int x, int y) { return apply(d, texture(x, y), t + 0.1 * t * t); });
    };
    for (int t = 0; t < 8; ++t) context.frames.push_back(frame(t));
    const Forecast f = affinergb(unregularized(AffineFamily::full, 2)).forecast(context);
    EXPECT_LT(largest_difference(f.at(6), frame(13)), 1e-4);
    EXPECT_GT(largest_difference(
                  affinergb(unregularized(AffineFamily::full)).forecast(context).at(6), frame(13)),
              1e-2);
}

TEST(Affine, NothingMovesNothingDrifts) {
    for (double k : {0.0, 30.0}) {
        AffineOptions options;
        options.ridge_k = k;
        const AffineFit fit = fit_affine(drifting(6, {}), options);
        expect_drift(fit.linear, {}, 1e-12);
    }
}

TEST(Affine, TooLittleToFitGivesNoDrift) {
    expect_drift(fit_affine(drifting(1, planted_drift())).linear, {}, 0);
    Context blind = drifting(6, planted_drift());
    blind.clipped = Mask(48, 40);
    for (auto& v : blind.clipped.pixels()) v = kInside;
    const AffineFit fit = fit_affine(blind);
    EXPECT_EQ(fit.pixels, 0);
    expect_drift(fit.linear, {}, 0);
    // Two frames carry a line but no parabola.
    const AffineFit two =
        fit_affine(drifting(2, planted_drift()), unregularized(AffineFamily::full, 2));
    expect_drift(two.linear, planted_drift(), 1e-5);
    expect_drift(two.quadratic, {}, 0);
}

TEST(Affine, FlatAndGrayImagesStaySolvable) {
    for (const double k : {0.0, 30.0}) {
        AffineOptions options;
        options.ridge_k = k;
        Context flat, gray;
        for (int t = 0; t < 6; ++t) {
            const float up = 0.01f * float(t);
            flat.frames.push_back(paint(20, 20, [=](int, int) {
                return SrgbF{0.4f + up, 0.3f, 0.2f};
            }));
            gray.frames.push_back(paint(20, 20, [=](int x, int) {
                const float v = 0.2f + 0.02f * float(x) + up;
                return SrgbF{v, v, v};
            }));
        }
        EXPECT_NEAR(affinergb(options).forecast(flat).at(10)(3, 3).r, 0.55, 1e-4);
        EXPECT_NEAR(affinergb(options).forecast(gray).at(10)(3, 3).g, 0.2 + 0.06 + 0.15, 1e-3);
    }
}

TEST(Affine, MovesOnlyTheSpecimenAndNeverTheGlint) {
    Context context = drifting(6, planted_drift());
    context.specimen = Mask(48, 40);
    context.clipped = Mask(48, 40);
    for (int y = 10; y < 30; ++y) {
        for (int x = 10; x < 30; ++x) context.specimen(x, y) = kInside;
    }
    context.clipped(15, 15) = kInside;
    const Forecast f = affinergb(unregularized(AffineFamily::full)).forecast(context);
    const Image<SrgbF> later = f.at(8);
    EXPECT_EQ(later(5, 5), context.frames.back()(5, 5));
    EXPECT_EQ(later(15, 15), context.frames.back()(15, 15));
    EXPECT_NE(later(16, 15), context.frames.back()(16, 15));
}

TEST(Affine, SpecimenPixelsAloneCanSteer) {
    Context context = drifting(6, planted_drift());
    context.specimen = Mask(48, 40);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 48; ++x) {
            if (x < 24)
                context.specimen(x, y) = kInside;
            else
                for (auto& f : context.frames) f(x, y) = {0.5f, 0.5f, 0.5f};
        }
    }
    AffineOptions options = unregularized(AffineFamily::full);
    options.pixels = FitPixels::specimen;
    const AffineFit fit = fit_affine(context, options);
    expect_drift(fit.linear, planted_drift(), 5e-6);
    EXPECT_EQ(fit.pixels, 24 * 40);
}

TEST(Affine, ClippedPixelsNeverSteer) {
    Context context = drifting(6, planted_drift());
    context.clipped = Mask(48, 40);
    for (int y = 5; y < 9; ++y) {
        for (int x = 5; x < 40; ++x) {
            context.clipped(x, y) = kInside;
            for (auto& f : context.frames) f(x, y) = {1, 1, 1};
        }
    }
    expect_drift(fit_affine(context, unregularized(AffineFamily::full)).linear, planted_drift(),
                 5e-6);
}

// Regression dilution (docs/models/forecast.md): the noise of frame 0 is in the regressor and, with
// weight w_0 = -0.2 at n = 5, in the target. Where noise is all the color contrast there is, the
// plain fit reads it as S = -0.2.
TEST(Affine, RidgeHealsANearlyUniformColor) {
    constexpr double kSigma = 0.004;
    std::mt19937 random(5);
    const auto frame = [](double t) {
        return paint(64, 64, [t](int, int) {
            return SrgbF{float(0.6 - 0.02 * t), float(0.4 - 0.01 * t), float(0.3 + 0.005 * t)};
        });
    };
    Context context;
    context.sigma = kSigma;
    for (int t = 0; t < 5; ++t) {
        context.frames.push_back(frame(t));
        add_noise(context.frames.back(), kSigma, random);
    }
    const AffineFit plain = fit_affine(context, unregularized(AffineFamily::full));
    const AffineFit ridge = fit_affine(context);
    EXPECT_NEAR(ridge.sigma, kSigma, 0.1 * kSigma);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(plain.linear.S[c][c], -0.2, 0.05);
        EXPECT_NEAR(ridge.linear.S[c][c], -0.2 / 31, 0.005);
    }
    double plain_error = 0, ridge_error = 0, held_error = 0;
    for (int k = 1; k <= 10; ++k) {
        const Image<SrgbF> truth = frame(4 + k);
        plain_error += squared_error(
            affinergb(unregularized(AffineFamily::full)).forecast(context).at(k), truth);
        ridge_error += squared_error(affinergb().forecast(context).at(k), truth);
        held_error += squared_error(context.frames.back(), truth);
    }
    EXPECT_LT(ridge_error, 0.1 * plain_error);
    EXPECT_LT(plain_error, held_error);
}

TEST(ContextNoise, IgnoresAgingAndExposureSteps) {
    Context context = drifting(8, planted_drift(), 0.003, 9, 80, 80);
    for (SrgbF& c : context.frames[4].pixels()) c = {c.r + 0.05f, c.g + 0.05f, c.b + 0.05f};
    const Mask all = fit_mask(context, FitPixels::all);
    EXPECT_NEAR(context_noise(context.frames, all, 1), 0.003, 3e-4);
    EXPECT_EQ(context_noise(std::span(context.frames).first(3), all, 0.125), 0.125);
}

TEST(Affine, RefusesOptionsThatMakeNoSense) {
    AffineOptions third;
    third.order = 3;
    EXPECT_THROW(affinergb(third), Error);
    AffineOptions negative;
    negative.ridge_k = -1;
    EXPECT_THROW(affinergb(negative), Error);
}

}  // namespace
}  // namespace verdigris
