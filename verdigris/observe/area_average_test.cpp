// SPDX-License-Identifier: MIT
#include "verdigris/observe/area_average.h"

#include <gtest/gtest.h>

#include <cmath>

namespace verdigris {
namespace {

Image<SrgbF> pattern(int width, int height) {
    Image<SrgbF> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image(x, y) = {float(x), float(y), float((x * 7 + y * 13) % 17)};
        }
    }
    return image;
}

TEST(AreaAverage, OfAWholeNumberOfPixelsIsTheirMean) {
    const Image<SrgbF> out = resample(pattern(12, 8), 4, 4);
    EXPECT_FLOAT_EQ(out(0, 0).r, 1.0f);
    EXPECT_FLOAT_EQ(out(3, 0).r, 10.0f);
    EXPECT_FLOAT_EQ(out(0, 3).g, 6.5f);
}

TEST(AreaAverage, KeepsTheMeanAtAnyRatio) {
    for (const auto& [w, h] : {std::pair{7, 5}, {13, 11}, {30, 17}, {1, 1}}) {
        const Image<SrgbF> in = pattern(31, 19), out = resample(in, w, h);
        double before = 0, after = 0;
        for (const SrgbF c : in.pixels()) before += double(c.b);
        for (const SrgbF c : out.pixels()) after += double(c.b);
        EXPECT_NEAR(before / (31 * 19), after / (w * h), 1e-4) << w << " x " << h;
    }
}

TEST(AreaAverage, InPartsEqualsInOnePiece) {
    const Image<SrgbF> in = pattern(50, 41);
    const Resampling r{50, 41, 23, 16};
    const Image<SrgbF> whole = resample(in, 23, 16);
    for (const auto& [begin, end] : {std::pair{0, 5}, {5, 6}, {9, 16}}) {
        const auto [first, last] = r.source_rows(begin, end);
        Image<SrgbF> part(50, last - first);
        for (int y = first; y < last; ++y) std::copy_n(in.row(y), 50, part.row(y - first));
        const Image<SrgbF> out = resample_rows(part, first, r, begin, end);
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < 23; ++x) EXPECT_EQ(out(x, y - begin), whole(x, y));
        }
    }
}

TEST(AreaAverage, LargerOutputIsLinear) {
    Image<SrgbF> in(2, 1);
    in(1, 0) = {1, 1, 1};
    const Image<SrgbF> out = resample(in, 4, 2);
    EXPECT_FLOAT_EQ(out(0, 1).r, 0.0f);
    EXPECT_FLOAT_EQ(out(1, 1).r, 0.25f);
    EXPECT_FLOAT_EQ(out(3, 0).r, 1.0f);
}

TEST(AreaAverage, MasksAreCutAtOneHalf) {
    Mask mask(8, 8);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 5; ++x) mask(x, y) = kInside;
    }
    const Mask out = resample(mask, 4, 4);
    EXPECT_EQ(out(1, 0), kInside);
    EXPECT_EQ(out(2, 0), kInside);  // exactly half
    EXPECT_EQ(out(3, 0), 0);
}

TEST(AreaAverage, LongSide) {
    EXPECT_EQ(size_with_long_side(1920, 1080, 480), (std::pair{480, 270}));
    EXPECT_EQ(size_with_long_side(100, 100, 128), (std::pair{128, 128}));
    EXPECT_EQ(size_with_long_side(10000, 1, 10), (std::pair{10, 1}));
}

}  // namespace
}  // namespace verdigris
