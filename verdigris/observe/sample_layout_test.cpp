// SPDX-License-Identifier: MIT
// Samples stored as their planes must show what the frames show.
#include "verdigris/observe/sample_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "verdigris/error.h"
#include "verdigris/observe/bin_accumulator.h"
#include "verdigris/observe/layout_json.h"
#include "verdigris/observe/noise.h"
#include "verdigris/observe/sample_line.h"
#include "verdigris/observe/shrink.h"
#include "verdigris/recording/testing/made_planes.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

using testing::MadePlanes;

class Layouts : public ::testing::Test {
  protected:
    int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

    FrameFormat random_format(int trial) {
        constexpr int kShifts[][2] = {{1, 1}, {1, 0}, {0, 0}, {0, 1}, {2, 0}};
        const int* shift = kShifts[trial % 5];
        FrameFormat format = testing::yuv_format(pick(8, 90), pick(8, 90), shift[0], shift[1],
                                                 trial % 9 == 0 ? 16 : 8 + 2 * pick(0, 2));
        format.full_range = trial % 2;
        format.chroma_x = format.chroma_shift_x ? 0.5 * pick(0, 1) : 0;
        if (format.chroma_shift_y) format.chroma_y = 0.5 * pick(-1, 2);  // -0.5: odd and mirrored
        format.rotation = 90 * pick(0, 3);
        format.transfer = trial % 11 == 0 ? Transfer::hlg : Transfer::display;
        return format;
    }
    Rect random_crop(const FrameFormat& format) {
        const bool turned = format.rotation % 180 != 0;
        const int w = turned ? format.coded_height : format.coded_width;
        const int h = turned ? format.coded_width : format.coded_height;
        Rect crop{pick(0, w - 1), pick(0, h - 1), 0, 0};
        crop.width = pick(1, w - crop.x);
        crop.height = pick(1, h - crop.y);
        return crop;
    }
    static SampleCodes codes_of(const SampleLayout& layout, const FrameFormat& format,
                                const MadePlanes& planes) {
        BinAccumulator bin(format, layout.coded, 0.1);
        Frame frame;
        frame.planes = planes.set();
        bin.begin(1);
        bin.add(frame);
        SampleCodes codes(layout.codes());
        bin.codes(codes.data());
        return codes;
    }
    std::mt19937 random_{11};
};

TEST_F(Layouts, PlanesOfOneFrameShowExactlyWhatTheFrameShows) {
    for (int trial = 0; trial < 300; ++trial) {
        const FrameFormat format = random_format(trial);
        MadePlanes planes(format);
        planes.fill_random(random_);
        const Rect crop = random_crop(format);
        const SampleLayout layout = plane_layout(format, crop);
        ASSERT_NO_THROW(layout.check());
        const SampleCodes codes = codes_of(layout, format, planes);
        const Image<SrgbF> expected = srgb_from_planes(planes.set(), format, crop);
        const Image<SrgbF> got = rows_of_sample(layout, codes.data(), 0, layout.height());
        ASSERT_TRUE(got.same_size(expected));
        for (std::size_t i = 0; i < got.pixel_count(); ++i) {
            ASSERT_EQ(got.pixels()[i], expected.pixels()[i]) << "trial " << trial;
        }
        const int begin = pick(0, crop.height - 1), end = pick(begin + 1, crop.height);
        const Image<SrgbF> rows = rows_of_sample(layout, codes.data(), begin, end);
        ASSERT_EQ(rows.height(), end - begin);
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < crop.width; ++x) ASSERT_EQ(rows(x, y - begin), got(x, y));
        }
    }
}

TEST_F(Layouts, RgbIsRoundedToSixteenBits) {
    Image<SrgbF> image(19, 7);
    for (SrgbF& p : image.pixels()) {
        const auto value = [&] { return float(pick(-1000, 11000)) / 10000; };
        p = {value(), value(), value()};
    }
    const SampleLayout layout = rgb_layout(19, 7);
    SampleCodes codes(layout.codes());
    ASSERT_EQ(codes.size(), 19u * 7 * 3);
    pack_rgb(image, codes);
    const Image<SrgbF> back = rows_of_sample(layout, codes.data(), 0, 7);
    for (std::size_t i = 0; i < back.pixel_count(); ++i) {
        const SrgbF a = image.pixels()[i], b = back.pixels()[i];
        EXPECT_NEAR(b.r, std::clamp(a.r, 0.0f, 1.0f), 0.51 / 65535);
        EXPECT_NEAR(b.b, std::clamp(a.b, 0.0f, 1.0f), 0.51 / 65535);
    }
    SampleCodes again(layout.codes());
    pack_rgb(back, again);
    EXPECT_EQ(again, codes);
}

TEST_F(Layouts, ComeBackFromJson) {
    for (int trial = 0; trial < 50; ++trial) {
        const FrameFormat format = random_format(trial);
        const SampleLayout layout = plane_layout(format, random_crop(format));
        const auto json = json_of(layout);
        const SampleLayout back = layout_from(nlohmann::ordered_json::parse(json.dump()));
        EXPECT_EQ(json_of(back).dump(), json.dump());
        EXPECT_EQ(back.codes(), layout.codes());
    }
}

TEST_F(Layouts, ThatMakeNoSenseAreRefused) {
    const FrameFormat format = testing::yuv_format(64, 48, 1, 1, 8);
    const auto good = json_of(plane_layout(format, {10, 10, 20, 20}));
    ASSERT_NO_THROW(layout_from(good));
    const auto refused = [&](const char* key, nlohmann::ordered_json value) {
        auto bad = good;
        bad[key] = std::move(value);
        EXPECT_THROW(layout_from(bad), Error) << key << ": " << bad[key];
    };
    refused("model", "banana");
    refused("bits", 0);
    refused("bits", 40);
    refused("fraction_bits", 9);
    refused("kr", 1.5);
    refused("kb", 0.0);
    refused("chroma_shift", {3, 1});
    refused("chroma_shift", {0, 0});  // then other samples are needed than are stored
    refused("chroma_site", {-9.0, 0.5});
    refused("transfer", "gamma99");
    refused("primaries", "none");
    refused("frame", {0, 48});
    refused("rotation", 45);
    refused("stored", {0, 0, 64, 48});
    refused("shown", {10, 10, 60, 20});
    refused("shown", {10, 10, 0, 20});
    refused("shown", {10, 10, 2000000000, 2000000000});
}

// The record looks at tiles from afar first; it must find what looking at every pixel finds.
TEST_F(Layouts, ClippedPixelsAreFoundWhereverTheyAre) {
    int clipped = 0, passed = 0;
    for (int trial = 0; trial < 200; ++trial) {
        FrameFormat format = random_format(trial);
        format.coded_width = pick(100, 200), format.coded_height = pick(50, 90);
        const Rect crop = random_crop(format);
        const SampleLayout layout = plane_layout(format, crop);
        // Gray with a few bright, dark or colored spots, so that most tiles are far from clipping.
        MadePlanes planes(format);
        const double top = std::exp2(format.bits), white = (format.full_range ? 0.999 : 0.92) * top;
        for (int p = 0; p < 3; ++p) {
            const Rect all = plane_rect(format, p, {0, 0, format.coded_width, format.coded_height});
            for (int y = 0; y < all.height; ++y) {
                for (int x = 0; x < all.width; ++x) {
                    const int dice = pick(0, 4000);
                    double code = 0.5 * top;
                    if (dice == 0) code = p == 0 ? white : 0.9 * top;
                    if (dice == 1) code = p == 0 ? 0.063 * top : 0.1 * top;
                    planes.set_code(p, x, y, std::floor(code));
                }
            }
        }
        const SampleCodes codes = codes_of(layout, format, planes);
        ClipRecord record(layout);
        record.add(0, codes);
        const Mask got = record.mask(1);
        const Image<SrgbF> image = rows_of_sample(layout, codes.data(), 0, layout.height());
        for (int y = 0; y < crop.height; ++y) {
            for (int x = 0; x < crop.width; ++x) {
                bool expected = false;
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, crop.height - 1); ++v) {
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, crop.width - 1); ++u) {
                        expected = expected || is_clipped(image(u, v));
                    }
                }
                ASSERT_EQ(got(x, y) == kInside, expected) << trial << ": " << x << ", " << y;
                (expected ? clipped : passed) += 1;
            }
        }
    }
    EXPECT_GT(clipped, 100);
    EXPECT_GT(passed, 10000);
}

TEST_F(Layouts, ShrinkingPlanesShrinksTheColor) {
    for (const int rotation : {0, 90, 180, 270}) {
        FrameFormat format = testing::yuv_format(96, 60, 1, 1, 8);
        format.full_range = false;
        format.rotation = rotation;
        const bool turned = rotation % 180 != 0;
        const Rect whole{0, 0, turned ? 60 : 96, turned ? 96 : 60};
        const SampleLayout layout = plane_layout(format, whole);
        EXPECT_EQ(shrink_factor(layout, 4), 3);  // 60 / 2 has no quarter
        EXPECT_EQ(shrink_factor(layout, 7), 6);
        EXPECT_EQ(shrink_factor(plane_layout(format, {2, 2, 50, 50}), 4), 1);
        EXPECT_EQ(shrink_factor(rgb_layout(96, 60), 4), 1);
        // A ramp: its box means are known, and siting that is off by half a sample would show.
        MadePlanes planes(format);
        for (int y = 0; y < 60; ++y) {
            for (int x = 0; x < 96; ++x) planes.set_code(0, x, y, 60 + x);
        }
        for (int y = 0; y < 30; ++y) {
            for (int x = 0; x < 48; ++x) {
                planes.set_code(1, x, y, 100 + x);
                planes.set_code(2, x, y, 110 + y);
            }
        }
        const SampleCodes codes = codes_of(layout, format, planes);
        const Image<SrgbF> full = rows_of_sample(layout, codes.data(), 0, layout.height());
        const Image<SrgbF> small = shrunk_sample(layout, codes, 4);
        ASSERT_EQ(small.width(), whole.width / 3);
        ASSERT_EQ(small.height(), whole.height / 3);
        // At the border chroma repeats instead of going on; there the two need not agree.
        for (int y = 2; y < small.height() - 2; ++y) {
            for (int x = 2; x < small.width() - 2; ++x) {
                double r = 0, b = 0;
                for (int i = 0; i < 9; ++i) {
                    r += double(full(3 * x + i % 3, 3 * y + i / 3).r) / 9;
                    b += double(full(3 * x + i % 3, 3 * y + i / 3).b) / 9;
                }
                ASSERT_NEAR(small(x, y).r, r, 2e-4) << rotation << ": " << x << ", " << y;
                ASSERT_NEAR(small(x, y).b, b, 2e-4) << rotation << ": " << x << ", " << y;
            }
        }
    }
}

}  // namespace
}  // namespace verdigris
