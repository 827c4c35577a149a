// SPDX-License-Identifier: MIT
#include "verdigris/observe/bin_accumulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "verdigris/error.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// One interleaved or single plane of random samples of type T, with padding behind each row.
template <class T>
struct TestFrame {
    std::vector<T> samples;
    std::ptrdiff_t stride = 0;
    T& at(int x, int y) { return samples[std::size_t(y) * std::size_t(stride) + std::size_t(x)]; }
};

template <class T>
SampleType type_of();
template <>
SampleType type_of<std::uint8_t>() {
    return SampleType::u8;
}
template <>
SampleType type_of<std::uint16_t>() {
    return SampleType::u16;
}
template <>
SampleType type_of<float>() {
    return SampleType::f32;
}

template <class T>
TestFrame<T> random_frame(int n, int rows, std::mt19937& random) {
    TestFrame<T> frame;
    frame.stride = n + 3;
    frame.samples.resize(std::size_t(frame.stride) * std::size_t(rows));
    for (T& v : frame.samples) {
        if constexpr (std::is_same_v<T, float>) {
            v = float(random() % 100000) / 50000.0f - 0.5f;
        } else {
            v = T(random());
        }
    }
    return frame;
}

template <class T>
Frame frame_of(TestFrame<T>& data, int width, int height, int channels) {
    Frame frame;
    frame.planes.count = 1;
    frame.planes.plane[0] = {reinterpret_cast<const std::byte*>(data.samples.data()),
                             data.stride * std::ptrdiff_t(sizeof(T)),
                             width,
                             height,
                             channels,
                             type_of<T>()};
    return frame;
}

double reference(std::vector<double> values, double trim) {
    std::sort(values.begin(), values.end());
    const int drop = int(std::floor(trim * double(values.size())));
    double sum = 0;
    for (std::size_t i = std::size_t(drop); i < values.size() - std::size_t(drop); ++i) {
        sum += values[i];
    }
    return sum / double(int(values.size()) - 2 * drop);
}

template <class T>
class TrimmedMean : public ::testing::Test {};
using SampleTypes = ::testing::Types<std::uint8_t, std::uint16_t, float>;
TYPED_TEST_SUITE(TrimmedMean, SampleTypes);

TYPED_TEST(TrimmedMean, EqualsSortingForEveryCount) {
    using T = TypeParam;
    std::mt19937 random(7);
    FrameFormat format;
    format.type = type_of<T>();
    format.model = PixelModel::rgb;
    for (int count = 1; count <= 80; ++count) {
        // Odd sizes, so that tails of every length are met.
        const int width = 1 + int(random() % 47), height = 1 + int(random() % 5);
        const Rect part{std::min(width - 1, 2), 0, width - std::min(width - 1, 2), height};
        std::vector<TestFrame<T>> frames;
        BinAccumulator bin(format, part, 0.1);
        bin.begin(count);
        for (int i = 0; i < count; ++i)
            frames.push_back(random_frame<T>(3 * width, height, random));
        for (auto& frame : frames) bin.add(frame_of(frame, width, height, 3));
        ASSERT_EQ(bin.count(), count);
        const PlaneSet means = bin.means();
        ASSERT_EQ(means.plane[0].width, part.width);
        for (int y = 0; y < height; ++y) {
            const float* row = reinterpret_cast<const float*>(means.plane[0].data +
                                                              y * means.plane[0].stride_bytes);
            for (int x = 0; x < 3 * part.width; ++x) {
                std::vector<double> values;
                for (auto& frame : frames) values.push_back(double(frame.at(3 * part.x + x, y)));
                const double expected = reference(values, 0.1);
                ASSERT_NEAR(double(row[x]), expected,
                            1e-6 * std::max(1.0, std::fabs(expected)) +
                                (std::is_same_v<T, float> ? 1e-5 : 0))
                    << count << " frames, " << width << " x " << height << ", sample " << x;
            }
        }
    }
}

TYPED_TEST(TrimmedMean, OfMoreFramesThanFitAveragesGroupsFirst) {
    using T = TypeParam;
    std::mt19937 random(8);
    FrameFormat format;
    format.type = type_of<T>();
    format.bits = int(8 * sizeof(T));
    format.model = PixelModel::gray;
    const int width = 70, height = 3, count = 333;
    std::vector<TestFrame<T>> frames;
    for (int i = 0; i < count; ++i) frames.push_back(random_frame<T>(width, height, random));
    BinAccumulator bin(format, {0, 0, width, height}, 0.1);
    bin.begin(count);
    for (auto& frame : frames) bin.add(frame_of(frame, width, height, 1));
    const PlaneSet means = bin.means();
    for (int x = 0; x < width; ++x) {
        std::vector<double> groups;
        for (int g = 0; g < 80; ++g) {
            double sum = 0;
            const int from = g * count / 80, to = (g + 1) * count / 80;
            for (int i = from; i < to; ++i) sum += double(frames[std::size_t(i)].at(x, 1));
            groups.push_back(sum / (to - from));
        }
        const float* row =
            reinterpret_cast<const float*>(means.plane[0].data + means.plane[0].stride_bytes);
        // Group means are rounded to 1/256 of an 8-bit step, or to a 16-bit step.
        const double step = std::is_same_v<T, std::uint16_t> ? 0.5 : 0.002;
        EXPECT_NEAR(double(row[x]), reference(groups, 0.1), step);
    }
}

TEST(BinAccumulator, GroupsOfTenBitFramesKeepFractionsOfACode) {
    FrameFormat format;
    format.type = SampleType::u16;
    format.bits = 10;
    format.model = PixelModel::gray;
    const int width = 40, height = 2, count = 320;  // four frames in each of 80 groups
    BinAccumulator bin(format, {0, 0, width, height}, 0.1);
    bin.begin(count);
    std::vector<TestFrame<std::uint16_t>> frames(4);
    for (int i = 0; i < 4; ++i) {
        frames[std::size_t(i)].stride = width;
        // One frame in four is a code higher; the last column is white, and above what 10 bits
        // hold.
        frames[std::size_t(i)].samples.assign(std::size_t(width * height), i == 0 ? 501 : 500);
        for (int y = 0; y < height; ++y) {
            frames[std::size_t(i)].at(width - 2, y) = 1023;
            frames[std::size_t(i)].at(width - 1, y) = 60000;
        }
    }
    for (int i = 0; i < count; ++i) {
        bin.add(frame_of(frames[std::size_t(i % 4)], width, height, 1));
    }
    const PlaneSet means = bin.means();
    const float* row = reinterpret_cast<const float*>(means.plane[0].data);
    EXPECT_NEAR(row[0], 500.25, 0.01);
    EXPECT_NEAR(row[width - 2], 1023, 0.01);
    EXPECT_GE(row[width - 1], 1023);
}

TEST(BinAccumulator, SurvivesLostFrames) {
    std::mt19937 random(9);
    FrameFormat format;
    format.model = PixelModel::gray;
    const int width = 65, height = 2;
    for (const int came : {1, 2, 5, 19, 36}) {
        BinAccumulator bin(format, {0, 0, width, height}, 0.1);
        bin.begin(37);
        std::vector<TestFrame<std::uint8_t>> frames;
        for (int i = 0; i < came; ++i)
            frames.push_back(random_frame<std::uint8_t>(width, height, random));
        for (auto& frame : frames) bin.add(frame_of(frame, width, height, 1));
        const PlaneSet means = bin.means();
        const float* row = reinterpret_cast<const float*>(means.plane[0].data);
        for (int x = 0; x < width; ++x) {
            std::vector<double> values;
            for (auto& frame : frames) values.push_back(double(frame.at(x, 0)));
            EXPECT_NEAR(double(row[x]), reference(values, 0.1), 1e-4);
        }
    }
}

TEST(BinAccumulator, ReadsThePartOfEverySubsampledPlane) {
    FrameFormat format;
    format.model = PixelModel::yuv;
    format.chroma_shift_x = format.chroma_shift_y = 1;
    EXPECT_EQ(plane_rect(format, 0, {2, 4, 6, 8}), (Rect{2, 4, 6, 8}));
    EXPECT_EQ(plane_rect(format, 1, {2, 4, 6, 8}), (Rect{1, 2, 3, 4}));
    EXPECT_EQ(plane_rect(format, 2, {0, 0, 161, 121}), (Rect{0, 0, 81, 61}));
    std::vector<std::uint8_t> y(9 * 7, 10), u(5 * 4, 20), v(5 * 4, 30);
    u[1 * 5 + 2] = 99;
    Frame frame;
    frame.planes.count = 3;
    const auto bytes = [](const std::vector<std::uint8_t>& p) {
        return reinterpret_cast<const std::byte*>(p.data());
    };
    frame.planes.plane = {Plane{bytes(y), 9, 9, 7, 1, SampleType::u8},
                          Plane{bytes(u), 5, 5, 4, 1, SampleType::u8},
                          Plane{bytes(v), 5, 5, 4, 1, SampleType::u8}};
    BinAccumulator bin(format, {4, 2, 5, 5}, 0.1);
    bin.begin(1);
    bin.add(frame);
    const PlaneSet means = bin.means();
    ASSERT_EQ(means.count, 3);
    EXPECT_EQ(means.plane[1].width, 3);
    EXPECT_EQ(means.plane[1].height, 3);
    EXPECT_EQ(reinterpret_cast<const float*>(means.plane[1].data)[0], 99.0f);
    EXPECT_EQ(reinterpret_cast<const float*>(means.plane[2].data)[0], 30.0f);
}

TEST(BinAccumulator, RefusesAFrameOfAnotherSize) {
    FrameFormat format;
    format.model = PixelModel::gray;
    std::mt19937 random(1);
    auto data = random_frame<std::uint8_t>(20, 10, random);
    BinAccumulator bin(format, {0, 0, 20, 11}, 0.1);
    bin.begin(1);
    EXPECT_THROW(bin.add(frame_of(data, 20, 10, 1)), Error);
}

TEST(TrimRule, KeepsMemoryBoundedForAnyTrim) {
    EXPECT_EQ(TrimRule{0.1}.largest(), 80);
    EXPECT_EQ(TrimRule{0.0}.largest(), 80);
    EXPECT_EQ(TrimRule{0.25}.largest(), 35);
    EXPECT_EQ(TrimRule{0.49}.largest(), 18);
    EXPECT_EQ(TrimRule{0.1}.dropped(37), 3);
    EXPECT_EQ(TrimRule{0.49}.dropped(2), 0);
}

}  // namespace
}  // namespace verdigris
