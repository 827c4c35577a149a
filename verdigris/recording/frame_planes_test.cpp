// SPDX-License-Identifier: MIT
#include "verdigris/recording/frame_planes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "verdigris/recording/testing/made_planes.h"

extern "C" {
#include <libavutil/frame.h>
}

namespace verdigris {
namespace {

libav::FramePtr frame_of(AVPixelFormat layout, int width, int height) {
    libav::FramePtr frame = libav::new_frame();
    frame->format = layout;
    frame->width = width;
    frame->height = height;
    EXPECT_EQ(av_frame_get_buffer(frame.get(), 64), 0);
    return frame;
}

std::uint16_t sample16(const Plane& plane, int x, int y) {
    std::uint16_t value = 0;
    std::memcpy(&value, plane.data + y * plane.stride_bytes + 2 * x, 2);
    return value;
}

TEST(FramePlanes, PlanarFramesAreNotCopied) {
    const FrameFormat format = testing::yuv_format(5, 3, 1, 1, 8);
    libav::FramePtr frame = frame_of(AV_PIX_FMT_YUV420P, 5, 3);
    const AVFrame* raw = frame.get();
    const FramePlanes out = planes_of_frame(std::move(frame), format, false);
    ASSERT_EQ(out.planes.count, 3);
    for (std::size_t p = 0; p < 3; ++p) {
        EXPECT_EQ(static_cast<const void*>(out.planes.plane[p].data), raw->data[p]);
        EXPECT_EQ(out.planes.plane[p].stride_bytes, raw->linesize[p]);
        EXPECT_EQ(out.planes.plane[p].width, p ? 3 : 5);
        EXPECT_EQ(out.planes.plane[p].height, p ? 2 : 3);
    }
}

// p010 keeps 10 bits in the upper part of 16 and interleaves Cb with Cr.
TEST(FramePlanes, P010IsShiftedAndTakenApart) {
    const FrameFormat format = testing::yuv_format(5, 3, 1, 1, 10);
    libav::FramePtr frame = frame_of(AV_PIX_FMT_P010LE, 5, 3);
    const auto put = [&](int plane, int x, int y, int code) {
        std::uint8_t* to = frame->data[plane] + y * frame->linesize[plane] + 2 * x;
        to[0] = std::uint8_t(code << 6);
        to[1] = std::uint8_t(code >> 2);
    };
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) put(0, x, y, 100 + 10 * y + x);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            put(1, 2 * x, y, 500 + 10 * y + x);
            put(1, 2 * x + 1, y, 900 + 10 * y + x);
        }
    }
    const FramePlanes out = planes_of_frame(std::move(frame), format, false);
    ASSERT_EQ(out.planes.count, 3);
    EXPECT_EQ(sample16(out.planes.plane[0], 4, 2), 124);
    EXPECT_EQ(sample16(out.planes.plane[1], 2, 1), 512);
    EXPECT_EQ(sample16(out.planes.plane[2], 0, 1), 910);
}

// Mirrored frames are handed on from the last row up, planes of odd height included.
TEST(FramePlanes, MirroredFramesRunUpwards) {
    const FrameFormat format = testing::yuv_format(4, 3, 1, 1, 8);
    libav::FramePtr frame = frame_of(AV_PIX_FMT_YUV420P, 4, 3);
    for (int y = 0; y < 3; ++y) std::memset(frame->data[0] + y * frame->linesize[0], y, 4);
    for (int y = 0; y < 2; ++y) std::memset(frame->data[1] + y * frame->linesize[1], 10 + y, 2);
    const FramePlanes out = planes_of_frame(std::move(frame), format, true);
    const auto first_of = [&](std::size_t p, int y) {
        return int(out.planes.plane[p].data[y * out.planes.plane[p].stride_bytes]);
    };
    EXPECT_EQ(first_of(0, 0), 2);
    EXPECT_EQ(first_of(0, 2), 0);
    EXPECT_EQ(first_of(1, 0), 11);
    EXPECT_EQ(first_of(1, 1), 10);
}

}  // namespace
}  // namespace verdigris
