// SPDX-License-Identifier: MIT
#include "verdigris/recording/to_srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/recording/testing/made_planes.h"

namespace verdigris {
namespace {

using testing::MadePlanes;

constexpr SrgbF kCopper{200 / 255.0f, 100 / 255.0f, 50 / 255.0f};

float largest_difference(SrgbF a, SrgbF b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

struct Matrix {
    const char* name;
    double kr, kb;
};
constexpr Matrix kMatrices[] = {
    {"BT.709", 0.2126, 0.0722}, {"BT.601", 0.299, 0.114}, {"BT.2020", 0.2627, 0.0593}};

TEST(ToSrgb, CopperComesBackFromEveryMatrixRangeAndDepth) {
    for (const Matrix& matrix : kMatrices) {
        for (bool full : {true, false}) {
            for (int bits : {8, 10, 12, 16}) {
                FrameFormat format = testing::yuv_format(16, 10, 1, 1, bits);
                format.kr = matrix.kr;
                format.kb = matrix.kb;
                format.full_range = full;
                const MadePlanes planes = testing::solid_yuv(format, kCopper);
                const Image<SrgbF> image = srgb_from_planes(planes.set(), format, {0, 0, 16, 10});
                const std::string name = std::string(matrix.name) +
                                         (full ? " full " : " limited ") + std::to_string(bits) +
                                         " bit";
                for (const SrgbF& pixel : image.pixels()) {
                    const SrgbU8 code = u8_from_srgb(pixel);
                    ASSERT_LE(std::abs(code.r - 200), 1) << name;
                    ASSERT_LE(std::abs(code.g - 100), 1) << name;
                    ASSERT_LE(std::abs(code.b - 50), 1) << name;
                    // Half a code of Y' and of C each: what rounding the codes costs at most.
                    const float step = std::exp2(float(bits - 8)) * (full ? 255.0f : 219.0f);
                    ASSERT_LT(largest_difference(pixel, kCopper), (0.5f + 0.95f) / step) << name;
                }
            }
        }
    }
}

// Published code values of 75 % color bars, BT.709 limited 8 bit: yellow is Y 168, Cb 44, Cr 136.
TEST(ToSrgb, ReadsPublishedColorBarCodes) {
    FrameFormat format = testing::yuv_format(2, 2, 1, 1, 8);
    format.full_range = false;
    const MadePlanes planes = testing::solid_codes(format, {168, 44, 136});
    const Image<SrgbF> image = srgb_from_planes(planes.set(), format, {0, 0, 2, 2});
    EXPECT_LT(largest_difference(image(0, 0), {0.75f, 0.75f, 0.0f}), 1 / 255.0f);
}

TEST(ToSrgb, ClampsWhatNoDisplayShows) {
    FrameFormat format = testing::yuv_format(2, 2, 0, 0, 8);
    format.full_range = false;
    EXPECT_EQ(srgb_from_planes(testing::solid_codes(format, {255, 128, 128}).set(), format,
                               {0, 0, 1, 1})(0, 0),
              (SrgbF{1, 1, 1}));
    EXPECT_EQ(srgb_from_planes(testing::solid_codes(format, {0, 128, 128}).set(), format,
                               {0, 0, 1, 1})(0, 0),
              (SrgbF{0, 0, 0}));
}

TEST(ToSrgb, ReadsGrayAndBothKindsOfRgb) {
    FrameFormat format;
    format.coded_width = format.coded_height = 3;
    format.chroma_y = 0;
    format.model = PixelModel::gray;
    MadePlanes gray(format);
    gray.set_code(0, 1, 2, 128);
    EXPECT_EQ(srgb_from_planes(gray.set(), format, {0, 0, 3, 3})(1, 2),
              (SrgbF{128 / 255.0f, 128 / 255.0f, 128 / 255.0f}));

    format.model = PixelModel::rgb;
    MadePlanes planar(format);
    const double codes[] = {200, 100, 50};
    for (int c = 0; c < 3; ++c) planar.set_code(c, 2, 1, codes[c]);
    const SrgbF from_planar = srgb_from_planes(planar.set(), format, {0, 0, 3, 3})(2, 1);
    EXPECT_LT(largest_difference(from_planar, kCopper), 1e-6f);

    std::vector<std::uint8_t> packed(27);
    for (int c = 0; c < 3; ++c) packed[std::size_t(9 + 6 + c)] = std::uint8_t(codes[c]);
    PlaneSet set;
    set.count = 1;
    set.plane[0] = {reinterpret_cast<const std::byte*>(packed.data()), 9, 3, 3, 3, SampleType::u8};
    EXPECT_EQ(srgb_from_planes(set, format, {0, 0, 3, 3})(2, 1), from_planar);
}

// A chroma plane that is linear in space must be linear at the luma samples too, whatever the
// siting: this fails by half a pixel if a siting is ignored.
TEST(ToSrgb, ChromaIsInterpolatedAtItsSiting) {
    struct Siting {
        double x, y;
    };
    for (const Siting siting : {Siting{0, 0.5}, {0.5, 0.5}, {0, 0}, {0.5, 0}, {0, 1}}) {
        FrameFormat format = testing::yuv_format(32, 24, 1, 1, 8);
        format.chroma_x = siting.x;
        format.chroma_y = siting.y;
        format.type = SampleType::f32;  // unit scale, so that no rounding hides an error
        format.bits = 32;
        MadePlanes planes(format);
        const auto cr_at = [](double x, double y) { return 0.5 + 0.004 * x - 0.003 * y; };
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 32; ++x) planes.set_code(0, x, y, 0.5);
        for (int y = 0; y < 12; ++y) {
            for (int x = 0; x < 16; ++x) {
                planes.set_code(1, x, y, 0.5);
                planes.set_code(2, x, y, cr_at(2 * x + siting.x, 2 * y + siting.y));
            }
        }
        const Image<SrgbF> image = srgb_from_planes(planes.set(), format, {0, 0, 32, 24});
        for (int y = 2; y < 22; ++y) {
            for (int x = 2; x < 30; ++x) {
                const double cr = cr_at(x, y) - 0.5;
                ASSERT_NEAR(image(x, y).r, 0.5 + 2 * (1 - format.kr) * cr, 1e-6)
                    << "siting " << siting.x << ", " << siting.y << " at " << x << ", " << y;
            }
        }
    }
}

TEST(ToSrgb, TurnsClockwise) {
    // shown(x, y) of a turn by 90 is coded(y, h - 1 - x), and so on: written out, not computed.
    FrameFormat format;
    format.model = PixelModel::gray;
    format.coded_width = 5;
    format.coded_height = 3;
    MadePlanes planes(format);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) planes.set_code(0, x, y, 10 * x + y);
    const auto code = [](const Image<SrgbF>& image, int x, int y) {
        return int(std::lround(image(x, y).r * 255));
    };
    format.rotation = 90;
    const auto quarter = srgb_from_planes(planes.set(), format, {0, 0, 3, 5});
    format.rotation = 180;
    const auto half = srgb_from_planes(planes.set(), format, {0, 0, 5, 3});
    format.rotation = 270;
    const auto three = srgb_from_planes(planes.set(), format, {0, 0, 3, 5});
    EXPECT_EQ(code(quarter, 2, 0), 0);  // the coded top left corner is shown top right
    EXPECT_EQ(code(half, 4, 2), 0);     // bottom right
    EXPECT_EQ(code(three, 0, 4), 0);    // bottom left
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 3; ++x) {
            EXPECT_EQ(code(quarter, x, y), 10 * y + (2 - x));
            EXPECT_EQ(code(three, x, y), 10 * (4 - y) + x);
            EXPECT_EQ(code(half, y, x), 10 * (4 - y) + (2 - x));
        }
    }
}

// The contract with observe/: averaging only the samples under the crop gives the same bits as
// cropping the whole frame.
TEST(ToSrgb, PartOfAFrameGivesTheSamePixelsAsTheWhole) {
    std::mt19937 random(7);
    const auto pick = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    constexpr int kShifts[][2] = {{1, 1}, {1, 0}, {0, 0}, {0, 1}, {2, 0}};
    int compared = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        const int* shift = kShifts[trial % 5];
        FrameFormat format =
            testing::yuv_format(pick(1, 75), pick(1, 75), shift[0], shift[1], 8 + 2 * pick(0, 2));
        if (trial % 7 == 0) format.model = PixelModel::rgb;
        if (format.model == PixelModel::rgb) format.chroma_shift_x = format.chroma_shift_y = 0;
        format.full_range = trial % 2;
        format.chroma_x = format.chroma_shift_x ? 0.5 * pick(0, 1) : 0;
        format.chroma_y = format.chroma_shift_y ? 0.5 * pick(-1, 2) : 0;
        format.rotation = 90 * pick(0, 3);
        format.transfer = trial % 11 == 0 ? Transfer::hlg : Transfer::display;
        const bool means = trial % 3 == 0;  // f32 means of coded samples, as bins hold them
        MadePlanes whole(format, means);
        whole.fill_random(random);

        const bool turned = format.rotation % 180 != 0;
        const int w = turned ? format.coded_height : format.coded_width;
        const int h = turned ? format.coded_width : format.coded_height;
        Rect crop{pick(0, w - 1), pick(0, h - 1), 0, 0};
        crop.width = pick(1, w - crop.x);
        crop.height = pick(1, h - crop.y);

        const Rect coded = coded_rect(format, crop);
        ASSERT_EQ(coded.x % (1 << format.chroma_shift_x), 0);
        ASSERT_EQ(coded.y % (1 << format.chroma_shift_y), 0);
        const MadePlanes part = whole.part(coded);
        const Image<SrgbF> expected = srgb_from_planes(whole.set(), format, {0, 0, w, h});
        const Image<SrgbF> cropped = srgb_from_planes(whole.set(), format, crop);
        const Image<SrgbF> image = srgb_from_part(part.set(), coded, format, crop);
        for (int y = 0; y < crop.height; ++y) {
            for (int x = 0; x < crop.width; ++x, ++compared) {
                ASSERT_EQ(image(x, y), expected(crop.x + x, crop.y + y))
                    << "trial " << trial << " at " << x << ", " << y;
                ASSERT_EQ(cropped(x, y), image(x, y));
            }
        }
    }
    EXPECT_GT(compared, 100000);
}

TEST(ToSrgb, MeansOfCodesAreReadInCodeUnits) {
    FrameFormat format = testing::yuv_format(9, 7, 1, 1, 10);
    format.full_range = false;
    std::mt19937 random(1);
    MadePlanes codes(format);
    codes.fill_random(random);
    const MadePlanes means = codes.as_means();
    const auto a = srgb_from_planes(codes.set(), format, {0, 0, 9, 7});
    const auto b = srgb_from_planes(means.set(), format, {0, 0, 9, 7});
    for (std::size_t i = 0; i < a.pixel_count(); ++i) EXPECT_EQ(a.pixels()[i], b.pixels()[i]);
}

TEST(ToSrgb, CropOutsideTheFrameIsRefused) {
    const FrameFormat format = testing::yuv_format(8, 8, 1, 1, 8);
    const MadePlanes planes(format);
    EXPECT_THROW(srgb_from_planes(planes.set(), format, {1, 0, 8, 8}), Error);
    EXPECT_THROW(srgb_from_planes(planes.set(), format, {-1, 0, 4, 4}), Error);
    EXPECT_EQ(srgb_from_planes(planes.set(), format, {0, 0, 0, 0}).pixel_count(), 0u);
}

}  // namespace
}  // namespace verdigris
