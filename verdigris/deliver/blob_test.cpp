// SPDX-License-Identifier: MIT
#include "verdigris/deliver/blob.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "verdigris/deliver/testing.h"

namespace verdigris {
namespace {

TEST(Blob, ReturnsWithinHalfAStep) {
    Image<SrgbF> image(13, 7);
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 13; ++x) {
            image(x, y) = {std::sin(float(x * y)), 0.001f * float(x), -3.0f + float(y)};
        }
    }
    const Blob blob = encode_blob(image.view());
    EXPECT_EQ(blob.channels, 3);
    EXPECT_NEAR(blob.quantization.offset, -3, 1e-12);
    const std::vector<double> values =
        decoded_blob(13, 7, 3, blob.quantization.scale, blob.quantization.offset, blob.data);
    const double half = blob.quantization.scale / 2 * (1 + 1e-9);
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        EXPECT_NEAR(values[3 * i], image.pixels()[i].r, half);
        EXPECT_NEAR(values[3 * i + 1], image.pixels()[i].g, half);
        EXPECT_NEAR(values[3 * i + 2], image.pixels()[i].b, half);
    }
}

TEST(Blob, EndsOfTheRangeAreExact) {
    Image<float> image(3, 1);
    image(0, 0) = 0.25f;
    image(1, 0) = 0.75f;
    image(2, 0) = 0.5f;
    const Blob blob = encode_blob(image.view());
    const std::vector<double> values =
        decoded_blob(3, 1, 1, blob.quantization.scale, blob.quantization.offset, blob.data);
    EXPECT_EQ(values[0], 0.25);
    EXPECT_NEAR(values[1], 0.75, 1e-12);
}

TEST(Blob, ConstantAndBadValues) {
    Image<float> image(4, 2);
    for (float& v : image.pixels()) v = 0.125f;
    Blob blob = encode_blob(image.view());
    EXPECT_EQ(blob.quantization.scale, 0);
    for (double v : decoded_blob(4, 2, 1, 0, blob.quantization.offset, blob.data)) {
        EXPECT_EQ(v, 0.125);
    }
    image(1, 1) = std::numeric_limits<float>::quiet_NaN();
    image(2, 1) = std::numeric_limits<float>::infinity();
    blob = encode_blob(image.view());
    const std::vector<double> values =
        decoded_blob(4, 2, 1, blob.quantization.scale, blob.quantization.offset, blob.data);
    EXPECT_EQ(values[5], 0);
    EXPECT_EQ(values[6], 0);
    EXPECT_NEAR(values[0], 0.125, 1e-12);
}

TEST(Blob, OfAWindowIsOfThatWindow) {
    Image<float> image(6, 5);
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 6; ++x) image(x, y) = float(10 * y + x);
    }
    const Blob blob = encode_blob(ImageView<const float>(image.view()).window({2, 1, 3, 2}));
    const std::vector<double> values =
        decoded_blob(3, 2, 1, blob.quantization.scale, blob.quantization.offset, blob.data);
    const std::vector<double> expected{12, 13, 14, 22, 23, 24};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-3);
}

}  // namespace
}  // namespace verdigris
