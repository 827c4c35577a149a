// SPDX-License-Identifier: MIT
#include "verdigris/recording/yuv420_from_srgb.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/testing/exact_yuv420.h"

namespace verdigris {
namespace {

using testing::ExactYuv420;

// Rows 16 bytes longer than needed, filled with 77.
struct Made {
    explicit Made(ImageView<const SrgbU8> image)
        : y_stride(image.width() + 16),
          chroma_stride(image.width() / 2 + 16),
          y(std::size_t(y_stride * image.height()), 77),
          cb(std::size_t(chroma_stride * image.height() / 2), 77),
          cr(cb) {
        yuv420_from_srgb(image, {y.data(), cb.data(), cr.data(), y_stride, chroma_stride});
    }
    std::ptrdiff_t y_stride, chroma_stride;
    std::vector<std::uint8_t> y, cb, cr;
};

Image<SrgbU8> random_image(int width, int height, unsigned seed) {
    Image<SrgbU8> image(width, height);
    std::mt19937 random(seed);
    // Many extremes: they are where sums overflow.
    const auto pick = [&] {
        const auto v = random();
        return std::uint8_t(v & 256 ? v : v & 512 ? 255 : 0);
    };
    for (SrgbU8& p : image.pixels()) p = {pick(), pick(), pick()};
    return image;
}

TEST(Yuv420FromSrgb, IsTheNearestCodeEverywhere) {
    for (const auto& [width, height] : {std::pair{2, 2}, {64, 48}, {198, 130}, {1030, 6}}) {
        const auto image = random_image(width, height, unsigned(width));
        const ExactYuv420 exact(image);
        const Made made(image.view());
        EXPECT_LT(exact.distance(0, made.y.data(), made.y_stride).most, 0.513);
        EXPECT_LT(exact.distance(1, made.cb.data(), made.chroma_stride).most, 0.513);
        EXPECT_LT(exact.distance(2, made.cr.data(), made.chroma_stride).most, 0.513);
        for (int y = 0; y < height; ++y)
            EXPECT_EQ(made.y.at(std::size_t(y * made.y_stride + width)), 77);
    }
}

TEST(Yuv420FromSrgb, PublishedCodes) {
    // [BT709] 8-bit: white 235, black 16; full blue has Cb 240, full red Cr 240.
    const auto codes = [](SrgbU8 color) {
        Image<SrgbU8> image(4, 4);
        for (SrgbU8& p : image.pixels()) p = color;
        const Made made(image.view());
        return std::array<int, 3>{made.y[0], made.cb[0], made.cr[0]};
    };
    EXPECT_EQ(codes({255, 255, 255}), (std::array{235, 128, 128}));
    EXPECT_EQ(codes({0, 0, 0}), (std::array{16, 128, 128}));
    EXPECT_EQ(codes({255, 0, 0}), (std::array{63, 102, 240}));
    EXPECT_EQ(codes({0, 255, 0}), (std::array{173, 42, 26}));
    EXPECT_EQ(codes({0, 0, 255}), (std::array{32, 240, 118}));
    for (int gray = 0; gray < 256; ++gray) {
        const auto v = std::uint8_t(gray);
        EXPECT_EQ(codes({v, v, v})[1], 128);
        EXPECT_EQ(codes({v, v, v})[2], 128);
    }
}

TEST(Yuv420FromSrgb, ThreadsAndStridesChangeNothing) {
    const auto image = random_image(200, 180, 3);
    const Made all(image.view());
    set_thread_count(1);
    const Made one(image.view());
    set_thread_count(0);
    EXPECT_EQ(all.y, one.y);
    EXPECT_EQ(all.cb, one.cb);
    EXPECT_EQ(all.cr, one.cr);
    // A window on a larger picture is read as itself.
    const auto window = image.view().window({10, 20, 64, 32});
    const ExactYuv420 exact(window);
    const Made part(window);
    EXPECT_LT(exact.distance(1, part.cb.data(), part.chroma_stride).most, 0.513);
}

}  // namespace
}  // namespace verdigris
