// SPDX-License-Identifier: MIT
// What goes into an encoder as known codes comes out as the color they mean.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "verdigris/color/convert.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/made_video.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

using namespace testing;

constexpr SrgbF kCopper{200 / 255.0f, 100 / 255.0f, 50 / 255.0f};
constexpr int kWidth = 64, kHeight = 48;

Image<SrgbF> first_frame(const Recording& recording) {
    const auto reader = recording.read();
    Frame frame;
    EXPECT_TRUE(reader->next(frame));
    const RecordingInfo& info = recording.info();
    return srgb_from_planes(frame.planes, info.format, {0, 0, info.width, info.height});
}

void expect_copper(const Recording& recording, int tolerance) {
    const Image<SrgbF> image = first_frame(recording);
    ASSERT_TRUE(image.same_size(kWidth, kHeight));
    for (const SrgbF& pixel : image.pixels()) {
        const SrgbU8 code = u8_from_srgb(pixel);
        ASSERT_LE(std::abs(code.r - 200), tolerance);
        ASSERT_LE(std::abs(code.g - 100), tolerance);
        ASSERT_LE(std::abs(code.b - 50), tolerance);
    }
}

// Two frames of copper, as the codes that `format` gives it.
RawVideo copper(const FrameFormat& format, const std::string& pixel_format) {
    const std::string frame = raw_bytes(solid_yuv(format, kCopper).set());
    return {pixel_format, format.coded_width, format.coded_height, frame + frame};
}

FrameFormat format_of(int shift_x, int shift_y, int bits, bool full, double kr, double kb) {
    FrameFormat format = yuv_format(kWidth, kHeight, shift_x, shift_y, bits);
    format.full_range = full;
    format.kr = kr;
    format.kb = kb;
    return format;
}

TEST(VideoColor, EveryMatrixRangeAndDepthOfH264) {
    NEEDS_FFMPEG();
    if (!have_encoder("libx264")) GTEST_SKIP() << "this ffmpeg has no libx264";
    struct Tag {
        const char *name, *described;
        double kr, kb;
    };
    const Scratch scratch;
    for (const Tag& tag :
         {Tag{"bt709", "BT.709", 0.2126, 0.0722}, Tag{"smpte170m", "BT.601", 0.299, 0.114},
          Tag{"bt2020nc", "BT.2020", 0.2627, 0.0593}}) {
        for (const bool full : {true, false}) {
            for (const int bits : {8, 10}) {
                SCOPED_TRACE(std::string(tag.name) + (full ? " full " : " limited ") +
                             std::to_string(bits));
                const FrameFormat format = format_of(1, 1, bits, full, tag.kr, tag.kb);
                ASSERT_TRUE(encode(copper(format, bits == 8 ? "yuv420p" : "yuv420p10le"),
                                   std::string("-c:v libx264 -qp 0 -colorspace ") + tag.name +
                                       " -color_range " + (full ? "pc" : "tv"),
                                   scratch / "a.mp4"));
                const Recording recording = open_recording(scratch / "a.mp4");
                EXPECT_EQ(recording.info().color_description,
                          std::string(tag.described) + (full ? " full" : " limited") + " range, " +
                              std::to_string(bits) + " bit");
                EXPECT_FALSE(has_note(recording.info().notes, "assumed_color"));
                EXPECT_EQ(recording.info().format.full_range, full);
                expect_copper(recording, 1);
            }
        }
    }
}

TEST(VideoColor, EveryCodec) {
    NEEDS_FFMPEG();
    struct Codec {
        const char *encoder, *arguments, *pixel_format, *file, *name;
        int shift_x, shift_y, bits, tolerance;
    };
    // Tolerance 1 where the coding is lossless; lossy coders may be off by their own quantizer.
    const Codec codecs[] = {
        {"libx265", "-preset ultrafast -x265-params lossless=1:log-level=none", "yuv420p", "a.mp4",
         "hevc", 1, 1, 8, 1},
        {"libx265", "-preset ultrafast -x265-params lossless=1:log-level=none", "yuv422p10le",
         "b.mkv", "hevc", 1, 0, 10, 1},
        {"libx265", "-preset ultrafast -x265-params lossless=1:log-level=none", "yuv444p12le",
         "b.mp4", "hevc", 0, 0, 12, 1},
        {"libx264", "-qp 0", "yuv444p", "c.mp4", "h264", 0, 0, 8, 1},
        {"ffv1", "", "yuv420p", "d.mkv", "ffv1", 1, 1, 8, 1},
        {"ffv1", "", "yuv422p10le", "e.mkv", "ffv1", 1, 0, 10, 1},
        {"ffv1", "", "yuv444p12le", "f.mkv", "ffv1", 0, 0, 12, 1},
        {"ffv1", "", "yuv444p16le", "f.nut", "ffv1", 0, 0, 16, 1},
        {"libvpx-vp9", "-lossless 1", "yuv420p", "g.webm", "vp9", 1, 1, 8, 1},
        {"libvpx-vp9", "-lossless 1 -profile:v 2", "yuv420p10le", "h.webm", "vp9", 1, 1, 10, 1},
        {"libaom-av1", "-crf 0 -b:v 0 -cpu-used 8", "yuv420p", "i.mkv", "av1", 1, 1, 8, 1},
        {"libaom-av1", "-crf 0 -b:v 0 -cpu-used 8", "yuv420p10le", "j.mp4", "av1", 1, 1, 10, 1},
        {"mpeg4", "-q:v 1", "yuv420p", "k.avi", "mpeg4", 1, 1, 8, 3},
    };
    const Scratch scratch;
    for (const Codec& codec : codecs) {
        SCOPED_TRACE(std::string(codec.encoder) + " " + codec.pixel_format);
        if (!have_encoder(codec.encoder)) continue;
        // BT.601 limited: what is assumed for so small a frame where a container keeps no tags.
        const FrameFormat format =
            format_of(codec.shift_x, codec.shift_y, codec.bits, false, 0.299, 0.114);
        ASSERT_TRUE(encode(copper(format, codec.pixel_format),
                           std::string("-c:v ") + codec.encoder + " " + codec.arguments +
                               " -colorspace smpte170m -color_range tv",
                           scratch / codec.file));
        const Recording recording = open_recording(scratch / codec.file);
        const RecordingInfo& info = recording.info();
        EXPECT_EQ(info.codec, codec.name);
        EXPECT_EQ(info.format.bits, codec.bits);
        EXPECT_EQ(info.format.chroma_shift_x, codec.shift_x);
        EXPECT_EQ(info.format.chroma_shift_y, codec.shift_y);
        ASSERT_EQ(info.times.size(), 2u);
        EXPECT_NEAR(info.times[1], 0.1, 0.002);
        expect_copper(recording, codec.tolerance);
    }
}

TEST(VideoColor, MjpegIsFullRangeAndCentered) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    const FrameFormat format = format_of(1, 1, 8, true, 0.299, 0.114);
    ASSERT_TRUE(encode(copper(format, "yuvj420p"), "-c:v mjpeg -q:v 1", scratch / "a.avi"));
    const Recording recording = open_recording(scratch / "a.avi");
    EXPECT_TRUE(recording.info().format.full_range);
    EXPECT_EQ(recording.info().format.chroma_x, 0.5);
    EXPECT_EQ(recording.info().format.chroma_y, 0.5);
    expect_copper(recording, 3);
}

// Layouts that are not planes of samples are laid out anew, to the same bits.
TEST(VideoColor, PackedAndSemiPlanarLayouts) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    const auto repeat = [](const std::string& unit, int count) {
        std::string bytes;
        for (int i = 0; i < count; ++i) bytes += unit;
        return bytes;
    };
    const auto pair16 = [](int a, int b) {  // little-endian
        return std::string{char(a & 255), char(a >> 8), char(b & 255), char(b >> 8)};
    };
    const auto chars = [](std::initializer_list<int> values) {
        std::string bytes;
        for (int v : values) bytes += char(v);
        return bytes;
    };
    const auto c8 = codes_of(format_of(1, 1, 8, false, 0.299, 0.114), kCopper);
    const auto c10 = codes_of(format_of(1, 1, 10, false, 0.299, 0.114), kCopper);
    const int n = kWidth * kHeight;
    const RawVideo videos[] = {
        {"nv12", kWidth, kHeight, repeat(chars({c8[0]}), n) + repeat(chars({c8[1], c8[2]}), n / 4)},
        {"nv21", kWidth, kHeight, repeat(chars({c8[0]}), n) + repeat(chars({c8[2], c8[1]}), n / 4)},
        {"yuyv422", kWidth, kHeight, repeat(chars({c8[0], c8[1], c8[0], c8[2]}), n / 2)},
        {"uyvy422", kWidth, kHeight, repeat(chars({c8[1], c8[0], c8[2], c8[0]}), n / 2)},
        {"rgb24", kWidth, kHeight, repeat(chars({200, 100, 50}), n)},
        {"bgr24", kWidth, kHeight, repeat(chars({50, 100, 200}), n)},
        {"rgba", kWidth, kHeight, repeat(chars({200, 100, 50, 7}), n)},
        {"bgr0", kWidth, kHeight, repeat(chars({50, 100, 200, 0}), n)},
        {"gbrp", kWidth, kHeight,
         repeat(chars({100}), n) + repeat(chars({50}), n) + repeat(chars({200}), n)},
        {"rgb48le", kWidth, kHeight,
         repeat(pair16(200 * 257, 100 * 257) + pair16(50 * 257, 0).substr(0, 2), n)},
        {"rgb48be", kWidth, kHeight, repeat(chars({200, 200, 100, 100, 50, 50}), n)},
        {"yuv444p10be", kWidth, kHeight,
         repeat(chars({c10[0] >> 8, c10[0]}), n) + repeat(chars({c10[1] >> 8, c10[1]}), n) +
             repeat(chars({c10[2] >> 8, c10[2]}), n)},
    };
    for (const RawVideo& video : videos) {
        SCOPED_TRACE(video.pixel_format);
        const auto file = scratch / (video.pixel_format + ".nut");
        ASSERT_TRUE(encode(video, "-c:v rawvideo -pix_fmt " + video.pixel_format, file));
        const Recording recording = open_recording(file);
        EXPECT_EQ(recording.info().format.bits,
                  video.pixel_format.find("10") != std::string::npos   ? 10
                  : video.pixel_format.find("48") != std::string::npos ? 16
                                                                       : 8);
        expect_copper(recording, 1);
    }
    const std::string gray = repeat(chars({77}), n);
    ASSERT_TRUE(
        encode({"gray", kWidth, kHeight, gray}, "-c:v ffv1 -color_range pc", scratch / "gray.mkv"));
    const Recording recording = open_recording(scratch / "gray.mkv");
    EXPECT_EQ(recording.info().format.model, PixelModel::gray);
    EXPECT_EQ(u8_from_srgb(first_frame(recording)(3, 3)), (SrgbU8{77, 77, 77}));
    ASSERT_TRUE(encode({"pal8", kWidth, kHeight, repeat(chars({1}), n) + std::string(1024, '\3')},
                       "-c:v rawvideo", scratch / "pal.nut"));
    const Error error = error_of([&] { open_recording(scratch / "pal.nut"); });
    EXPECT_NE(error.sentence().find("pixel layout 'pal8'"), std::string::npos) << error.what();
}

TEST(VideoColor, WhatTheFileDoesNotSayIsAssumedAndNoted) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    const FrameFormat small = format_of(1, 1, 8, false, 0.299, 0.114);
    ASSERT_TRUE(encode(copper(small, "yuv420p"), "-c:v ffv1", scratch / "small.nut"));
    const Recording recording = open_recording(scratch / "small.nut");
    EXPECT_TRUE(has_note(recording.info().notes, "assumed_color"));
    EXPECT_EQ(recording.info().color_description, "BT.601 limited range, 8 bit (assumed)");
    expect_copper(recording, 1);

    FrameFormat large = yuv_format(64, 720, 1, 1, 8);
    large.full_range = false;
    ASSERT_TRUE(encode(copper(large, "yuv420p"), "-c:v ffv1", scratch / "large.nut"));
    EXPECT_EQ(open_recording(scratch / "large.nut").info().color_description,
              "BT.709 limited range, 8 bit (assumed)");

    RecordingOptions options;
    options.assume_matrix = "bt2020";
    options.assume_range = "full";
    const FrameFormat given = format_of(1, 1, 8, true, 0.2627, 0.0593);
    ASSERT_TRUE(encode(copper(given, "yuv420p"), "-c:v ffv1", scratch / "given.nut"));
    expect_copper(open_recording(scratch / "given.nut", options), 1);

    options.assume_matrix = "bt1";
    EXPECT_EQ(error_of([&] { open_recording(scratch / "small.nut", options); }).code(),
              ErrorCode::usage);
    options.assume_matrix = {};
    options.assume_range = "half";
    EXPECT_EQ(error_of([&] { open_recording(scratch / "small.nut", options); }).code(),
              ErrorCode::usage);
}

// HLG and PQ reach to_srgb as such, not as display codes: 75 % HLG is reference white [BT2408].
TEST(VideoColor, HdrTagsAreRead) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    FrameFormat format = format_of(1, 1, 10, false, 0.2627, 0.0593);
    const std::string white = raw_bytes(solid_yuv(format, {0.75f, 0.75f, 0.75f}).set());
    ASSERT_TRUE(encode({"yuv420p10le", kWidth, kHeight, white},
                       "-c:v libx265 -x265-params lossless=1:log-level=none -colorspace bt2020nc "
                       "-color_range tv -color_trc arib-std-b67 -color_primaries bt2020",
                       scratch / "hlg.mp4"));
    const Recording recording = open_recording(scratch / "hlg.mp4");
    EXPECT_EQ(recording.info().format.transfer, Transfer::hlg);
    EXPECT_EQ(recording.info().format.primaries, Primaries::bt2020);
    EXPECT_EQ(recording.info().color_description, "BT.2020 limited range, 10 bit, HLG");
    const SrgbF pixel = first_frame(recording)(5, 5);
    EXPECT_NEAR(pixel.r, 1.0f, 0.005f);
    EXPECT_NEAR(pixel.b, 1.0f, 0.005f);
}

}  // namespace
}  // namespace verdigris
