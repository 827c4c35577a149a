// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_split.h"

#include <gtest/gtest.h>

#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

constexpr int kSide = 64;

Mask plate_mask() {
    Mask mask(kSide, kSide);
    for (int y = 8; y < 56; ++y)
        for (int x = 16; x < kSide; ++x) mask(x, y) = kInside;
    return mask;
}

TEST(MaskedGaussian, KeepsAConstantAndSeesNothingOutside) {
    const Mask mask = plate_mask();
    Field field(mask.pixel_count(), 0);
    for (std::size_t i = 0; i < field.size(); ++i) field[i] = mask.pixels()[i] ? 0.25f : 0;
    for (const int sigma : {1, 2, 4, 8}) {
        Field out;
        MaskedGaussian(mask, sigma).mean(field, out);
        for (std::size_t i = 0; i < out.size(); ++i)
            ASSERT_NEAR(out[i], mask.pixels()[i] ? 0.25 : 0, 1e-6) << sigma;
    }
}

TEST(MaskedGaussian, IsTheGaussianMean) {
    Mask mask(kSide, kSide);
    for (auto& v : mask.pixels()) v = kInside;
    Field field(mask.pixel_count(), 0);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            field[std::size_t(y * kSide + x)] = float(std::sin(0.2 * x) + std::cos(0.13 * y));
    for (const int sigma : {1, 2, 4}) {
        Field out;
        MaskedGaussian(mask, sigma).mean(field, out);
        double sum = 0, weights = 0;  // at the middle, by the definition
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const double w = std::exp(-0.5 * ((x - 32) * (x - 32) + (y - 32) * (y - 32)) /
                                          double(sigma * sigma));
                sum += w * double(field[std::size_t(y * kSide + x)]), weights += w;
            }
        }
        EXPECT_NEAR(out[32 * kSide + 32], sum / weights, sigma < 4 ? 5e-3 : 4e-2) << sigma;
    }
}

}  // namespace
}  // namespace verdigris
