// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/masked_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace verdigris {
namespace {

Image<SrgbF> noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0, 1);
    Image<SrgbF> image(width, height);
    for (SrgbF& c : image.pixels()) c = {value(random), value(random), value(random)};
    return image;
}

TEST(MaskedError, IsThePlainSumOverTheMask) {
    // 2 * 1024 and a rest that is no multiple of any vector.
    const Image<SrgbF> a = noise(61, 43, 1), b = noise(61, 43, 2);
    Mask changed(61, 43), metal(61, 43);
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        changed.pixels()[i] = i % 3 == 0 ? kInside : 0;
        metal.pixels()[i] = i % 5 != 0 ? kInside : 0;
    }
    const MaskedError e =
        masked_error(a, b, weights_of(changed, 61, 43), weights_of(metal, 61, 43));
    double fg = 0, whole = 0, absolute = 0, bias = 0, fg_count = 0, count = 0;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        const SrgbF p = a.pixels()[i], q = b.pixels()[i];
        const double d[3] = {double(p.r) - double(q.r), double(p.g) - double(q.g),
                             double(p.b) - double(q.b)};
        const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (changed.pixels()[i]) fg += square, fg_count += 3;
        if (metal.pixels()[i]) {
            whole += square, count += 3, bias += d[2];
            absolute += std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]);
        }
    }
    EXPECT_NEAR(e.foreground, fg / fg_count, 1e-7);
    EXPECT_NEAR(e.specimen, whole / count, 1e-7);
    EXPECT_NEAR(e.absolute, absolute / count, 1e-7);
    EXPECT_NEAR(e.bias[2], 3 * bias / count, 1e-7);
    EXPECT_TRUE(std::isnan(
        masked_error(a, b, weights_of(Mask(61, 43), 61, 43), weights_of({}, 61, 43)).foreground));
}

TEST(MaskedError, KeepsSmallErrorsOfLargeImages) {
    // The paper's errors are 1e-5, over sums of 16384 pixels.
    Image<SrgbF> a(128, 128), b(128, 128);
    for (SrgbF& c : a.pixels()) c = {0.5f, 0.5f, 0.5f};
    for (SrgbF& c : b.pixels()) c = {0.503f, 0.503f, 0.503f};
    const PixelWeights all = weights_of({}, 128, 128);
    const double step = double(0.503f) - 0.5;
    EXPECT_NEAR(masked_error(a, b, all, all).foreground, step * step, 1e-11);
    EXPECT_NEAR(masked_error(a, b, all, all).bias[1], -step, 1e-8);
}

TEST(Canvas, IsTheMedianAndForEvenNumbersTheMiddleOfTwo) {
    std::vector<float> scratch;
    Image<SrgbF> canvas;
    for (const std::size_t n : {1, 2, 3, 5, 7, 10}) {
        std::vector<Image<SrgbF>> frames;
        for (std::size_t i = 0; i < n; ++i) frames.push_back(noise(7, 3, unsigned(i)));
        canvas_of(frames, canvas, scratch);
        for (std::size_t p = 0; p < canvas.pixel_count(); ++p) {
            std::vector<float> values;
            for (const auto& f : frames) values.push_back(f.pixels()[p].g);
            std::ranges::sort(values);
            EXPECT_FLOAT_EQ(canvas.pixels()[p].g, 0.5f * (values[(n - 1) / 2] + values[n / 2]));
        }
    }
}

struct Truths {
    Image<SrgbF> still{4, 1}, first{4, 1}, second{4, 1};
    Truths() {
        first(0, 0) = {0.003f, 0, 0};          // mean 0.001: at the threshold, not above
        first(1, 0) = {0.004f, 0, 0};          // above at horizon 1 only
        second(2, 0) = {0, -0.01f, 0.01f};     // above at horizon 2 only
        second(3, 0) = {0.02f, 0.02f, 0.02f};  // outside the area
    }
};

TEST(Foreground, IsWhatChangesAtAnyHorizonOrAtEach) {
    const Truths t;
    const Image<SrgbF>* truths[] = {&t.first, &t.second};
    Mask area(4, 1);
    for (int x = 0; x < 3; ++x) area(x, 0) = kInside;
    std::vector<PixelWeights> out;
    foreground_of(truths, t.still, 0.0011, MaskRule::union_of_horizons, weights_of(area, 4, 1),
                  out);
    ASSERT_EQ(out.size(), 1u);
    EXPECT_EQ(out[0].weight, (std::vector<float>{0, 1, 1, 0}));
    EXPECT_EQ(out[0].count, 2);
    foreground_of(truths, t.still, 0.0011, MaskRule::per_horizon, weights_of(area, 4, 1), out);
    ASSERT_EQ(out.size(), 2u);
    EXPECT_EQ(out[0].weight, (std::vector<float>{0, 1, 0, 0}));
    EXPECT_EQ(out[1].weight, (std::vector<float>{0, 0, 1, 0}));
    foreground_of(truths, t.still, 0.0011, MaskRule::union_of_horizons, weights_of({}, 4, 1), out);
    EXPECT_EQ(out[0].count, 3);
}

TEST(Foreground, TheThresholdIsTheNoisesOnePercentPoint) {
    // docs/PROTOCOL.md: of pure noise, tau = 2.40 sigma lets 1 % of the pixels pass at any of ten
    // horizons against the median of five; 1.97 sigma is the 1 % point of a single one.
    const double sigma = 1e-3;
    std::mt19937 random(7);
    std::normal_distribution<float> value(0.5f, float(sigma));
    std::vector<Image<SrgbF>> frames;
    for (int i = 0; i < 15; ++i) {
        frames.emplace_back(300, 300);
        for (SrgbF& c : frames.back().pixels()) c = {value(random), value(random), value(random)};
    }
    Image<SrgbF> canvas;
    std::vector<float> scratch;
    canvas_of(std::span(frames).first(5), canvas, scratch);
    std::vector<const Image<SrgbF>*> truths;
    for (std::size_t k = 5; k < 15; ++k) truths.push_back(&frames[k]);
    const PixelWeights all = weights_of({}, 300, 300);
    std::vector<PixelWeights> out;
    foreground_of(truths, canvas, 2.40 * sigma, MaskRule::union_of_horizons, all, out);
    EXPECT_NEAR(double(out[0].count) / 90000, 0.01, 0.003);
    foreground_of(truths, canvas, 1.97 * sigma, MaskRule::per_horizon, all, out);
    EXPECT_NEAR(double(out[4].count) / 90000, 0.01, 0.003);
    foreground_of(truths, canvas, 1.97 * sigma, MaskRule::union_of_horizons, all, out);
    EXPECT_NEAR(double(out[0].count) / 90000, 0.093, 0.004);
}

}  // namespace
}  // namespace verdigris
