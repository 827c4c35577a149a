// SPDX-License-Identifier: MIT
#include "verdigris/forecast/change_part.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

constexpr int kSide = 48;
constexpr double kGains[] = {1.02, 0.97, 1.005};

Mask all_but_an_edge() {
    Mask mask(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 4; x < kSide; ++x) mask(x, y) = kInside;
    return mask;
}

Image<SrgbF> pattern() {
    return paint(kSide, kSide, [](int x, int y) { return texture(x, y); });
}

/// Four frames of one pattern, each under its light.
Context flickering() {
    Context context;
    context.frames.push_back(pattern());
    double light = 1;
    for (const double gain : kGains) {
        light *= gain;
        context.frames.push_back(relit(pattern(), {light, light, light}));
    }
    context.sigma = 0.001;
    return context;
}

double energy(const Increments& increments) {
    double sum = 0;
    for (const ColorField& d : increments)
        for (const Field& plane : d)
            for (const float v : plane) sum += double(v) * double(v);
    return sum;
}

TEST(AffinePart, IsItsMeanAndWhatDependsOnColor) {
    const Context context = flickering();
    const Mask moving = all_but_an_edge();
    const Increments rest = increments_of(context, moving, {});
    const AffinePart all(context, moving, rest), mean = all.mean(), slopes = all.slopes();
    std::vector<float> of_all(kSide), of_mean(kSide), of_slopes(kSide);
    for (int i = 0; i < all.increments(); ++i) {
        for (int k = 0; k < 3; ++k) {
            double sum = 0, first = 0;
            for (int y = 0; y < kSide; ++y) {
                all.row(i, k, y, of_all.data());
                mean.row(i, k, y, of_mean.data());
                slopes.row(i, k, y, of_slopes.data());
                if (y == 0) first = double(of_mean[kSide - 1]);
                for (std::size_t x = 0; x < kSide; ++x) {
                    EXPECT_NEAR(of_mean[x] + of_slopes[x], of_all[x], 1e-6);
                    sum += double(of_slopes[x]);
                    EXPECT_NEAR(of_mean[x], x >= 4 ? first : 0, 1e-9);
                }
            }
            EXPECT_NEAR(sum / double(count_inside(moving)), 0, 1e-7);
        }
    }
    const Eigen::MatrixXd apart = mean.moments().gram + slopes.moments().gram;
    EXPECT_LT((apart - all.moments().gram).cwiseAbs().maxCoeff(),
              1e-9 * all.moments().gram.trace() + 1e-12);
    EXPECT_GT(slopes.moments().gram.trace(), 0);
}

TEST(LightPart, IsAllOfAFlicker) {
    const Context context = flickering();
    const Mask moving = all_but_an_edge();
    Increments rest = increments_of(context, moving, {});
    const double before = energy(rest);
    const LightPart part(context, moving, rest);
    ASSERT_EQ(part.increments(), 3);
    part.subtract(rest);
    EXPECT_LT(energy(rest), 1e-3 * before);
    // By what it makes of one pixel: an increment is log gain times the slope of the sRGB curve.
    for (int i = 0; i < 3; ++i) {
        const double log_gain = std::log(kGains[i]);
        Field row(kSide);
        part.row(i, 1, 20, row.data());
        const SrgbF c = context.frames[1](30, 20);
        const double slope = double(relit(pattern(), {1.01, 1.01, 1.01})(30, 20).g -
                                    relit(pattern(), {0.99, 0.99, 0.99})(30, 20).g) /
                             (std::log(1.01) - std::log(0.99));
        EXPECT_NEAR(double(row[30]), log_gain * slope, 0.03 * std::abs(log_gain * slope))
            << i << " at " << c.g;
        EXPECT_EQ(row[2], 0) << "outside of what moves";
    }
}

TEST(LightPart, LeavesAChangeOfColorAlone) {
    // Red rises by as much, weighed by what light would do, as blue falls.
    Context context = flickering();
    const Mask moving = all_but_an_edge();
    const Image<SrgbF> brighter = relit(pattern(), {1.01, 1.01, 1.01});
    Increments turned = increments_of(context, moving, {});
    for (ColorField& d : turned) {
        for (std::size_t at = 0; at < d[0].size(); ++at) {
            const bool inside = moving.pixels()[at] != 0;
            const SrgbF c = pattern().pixels()[at], b = brighter.pixels()[at];
            d[0][at] = inside ? 0.01f * (b.b - c.b) / (b.r - c.r) : 0;
            d[1][at] = 0;
            d[2][at] = inside ? -0.01f : 0;
        }
    }
    const double before = energy(turned);
    const LightPart part(context, moving, turned);
    part.subtract(turned);
    EXPECT_NEAR(energy(turned), before, 2e-3 * before);
}

TEST(LightPart, CombinesAsItsRowsDo) {
    const Context context = flickering();
    const Mask moving = all_but_an_edge();
    const Increments increments = increments_of(context, moving, {});
    const LightPart part(context, moving, increments);
    const Eigen::RowVector3d weights{0.5, -2, 1};
    const ColorField sum = part.combined(weights);
    Field row(kSide);
    for (int k = 0; k < 3; ++k) {
        for (const int y : {0, 17, kSide - 1}) {
            std::vector<double> expected(kSide, 0);
            for (int i = 0; i < 3; ++i) {
                part.row(i, k, y, row.data());
                for (std::size_t x = 0; x < kSide; ++x) expected[x] += weights[i] * double(row[x]);
            }
            for (std::size_t x = 0; x < kSide; ++x)
                EXPECT_NEAR(double(sum[std::size_t(k)][std::size_t(y) * kSide + x]), expected[x],
                            1e-7);
        }
    }
}

}  // namespace
}  // namespace verdigris
