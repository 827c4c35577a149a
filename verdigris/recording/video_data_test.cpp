// SPDX-License-Identifier: MIT
// The shared recordings: real files of phones, cameras and other projects.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "verdigris/files/sha256.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/made_video.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

using namespace testing;

Recording shared_video(const std::string& name) {
    return open_recording(shared_data() / "video" / name);
}

Image<SrgbF> shown(const Recording& recording, const Frame& frame) {
    const RecordingInfo& info = recording.info();
    return srgb_from_planes(frame.planes, info.format, {0, 0, info.width, info.height});
}

SrgbF mean_of(const Image<SrgbF>& image) {
    double r = 0, g = 0, b = 0;
    for (const SrgbF& p : image.pixels()) r += p.r, g += p.g, b += p.b;
    const double n = double(image.pixel_count());
    return {float(r / n), float(g / n), float(b / n)};
}

TEST(VideoData, EveryFileDecodesAsAnnounced) {
    NEEDS_SHARED_DATA("video");
    struct Expected {
        const char* name;
        int width, height, rotation, frames, decoded;
        bool full_range;
        const char* codec;
    };
    for (const Expected& e :
         {Expected{"copper_h264.mp4", 256, 256, 0, 100, 100, false, "h264"},
          Expected{"copper_h264_vfr.mp4", 256, 256, 0, 100, 100, false, "h264"},
          Expected{"copper_h264_rot90.mp4", 256, 256, 270, 100, 100, false, "h264"},
          Expected{"copper_mjpeg.avi", 256, 256, 0, 100, 100, true, "mjpeg"},
          Expected{"portrait_4k60.mp4", 2160, 3840, 90, 18, 18, true, "h264"},
          Expected{"sample_android_slow_motion.mp4", 1280, 720, 0, 7, 7, true, "h264"},
          Expected{"sample.avi", 960, 400, 0, 96, 96, false, "mpeg4"},
          Expected{"bear-vp9-odd-dimensions.webm", 161, 121, 0, 30, 30, false, "vp9"},
          Expected{"bt709_full_range.mp4", 1280, 720, 0, 30, 30, true, "h264"}}) {
        SCOPED_TRACE(e.name);
        const Recording recording = shared_video(e.name);
        const RecordingInfo& info = recording.info();
        EXPECT_EQ(info.kind, RecordingKind::video);
        EXPECT_EQ(info.width, e.width);
        EXPECT_EQ(info.height, e.height);
        EXPECT_EQ(info.format.rotation, e.rotation);
        EXPECT_EQ(info.format.full_range, e.full_range);
        EXPECT_EQ(info.codec, e.codec);
        EXPECT_EQ(info.time_source, TimeSource::container);
        ASSERT_EQ(int(info.times.size()), e.frames);
        EXPECT_EQ(info.times.front(), 0);
        EXPECT_FALSE(has_note(info.notes, "broken_tail"));
        const auto reader = recording.read();
        int count = 0;
        for (Frame frame; reader->next(frame); ++count) {
            ASSERT_EQ(frame.index, count);
            ASSERT_EQ(frame.seconds, info.times[std::size_t(count)]);
        }
        EXPECT_EQ(count, e.decoded);
        EXPECT_EQ(reader->report().decoded, e.decoded);
        EXPECT_EQ(reader->report().lost, e.frames - e.decoded);
        EXPECT_EQ(reader->report().reason, "");
    }
}

TEST(VideoData, VariableRateIsReadFromTheTimeStamps) {
    NEEDS_SHARED_DATA("video");
    const Recording vfr = shared_video("copper_h264_vfr.mp4");
    EXPECT_TRUE(vfr.info().variable_rate);
    int short_steps = 0, long_steps = 0;
    const std::vector<double>& times = vfr.info().times;
    for (std::size_t i = 1; i < times.size(); ++i) {
        short_steps += std::abs(times[i] - times[i - 1] - 0.05) < 1e-3;
        long_steps += std::abs(times[i] - times[i - 1] - 0.2) < 1e-3;
    }
    EXPECT_EQ(short_steps, 20);
    EXPECT_EQ(long_steps, 79);

    const Recording slow = shared_video("sample_android_slow_motion.mp4");
    EXPECT_TRUE(slow.info().variable_rate);
    EXPECT_NEAR(slow.info().times[1], 0.325, 0.001);
    for (std::size_t i = 2; i < 7; ++i) {
        EXPECT_NEAR(slow.info().times[i] - slow.info().times[i - 1], 0.0333, 0.001);
    }
    // AVI marks two frames as dropped: their time passes, no frame is there.
    const Recording avi = shared_video("sample.avi");
    EXPECT_NEAR(avi.info().times[1], 3 * 1001 / 24000.0, 1e-6);
    EXPECT_NEAR(avi.info().times[2], 4 * 1001 / 24000.0, 1e-6);
    EXPECT_FALSE(shared_video("copper_h264.mp4").info().variable_rate);
    // 29.97 frames per second in milliseconds: the steps differ by rounding only.
    EXPECT_FALSE(shared_video("bear-vp9-odd-dimensions.webm").info().variable_rate);
}

// FFmpeg's "rotation of 90" is counterclockwise: shown(x, y) = coded(w - 1 - y, x).
TEST(VideoData, RotationTurnsTheSamePicture) {
    NEEDS_SHARED_DATA("video");
    const Recording upright = shared_video("copper_h264.mp4");
    const Recording turned = shared_video("copper_h264_rot90.mp4");
    const auto a = upright.read(), b = turned.read();
    Frame frame;
    ASSERT_TRUE(a->next(frame));
    const Image<SrgbF> plain = shown(upright, frame);
    ASSERT_TRUE(b->next(frame));
    const Image<SrgbF> rotated = shown(turned, frame);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) ASSERT_EQ(rotated(x, y), plain(255 - y, x));
}

TEST(VideoData, CopperHasTheColorOfThePhotographs) {
    NEEDS_SHARED_DATA("real/copper_patinating");
    const Recording photos = open_recording(shared_data() / "real" / "copper_patinating");
    const Recording video = shared_video("copper_h264.mp4");
    const auto a = photos.read(), b = video.read();
    for (const int index : {0, 50, 99}) {
        Frame photo, coded;
        a->seek(index);
        b->seek(index);
        ASSERT_TRUE(a->next(photo));
        ASSERT_TRUE(b->next(coded));
        const SrgbF p = mean_of(shown(photos, photo)), v = mean_of(shown(video, coded));
        // 3 codes: the transcoding shifted the clip by up to 2.3 (measured, G of frame 0).
        EXPECT_NEAR(p.r, v.r, 3 / 255.0);
        EXPECT_NEAR(p.g, v.g, 3 / 255.0);
        EXPECT_NEAR(p.b, v.b, 3 / 255.0);
    }
}

TEST(VideoData, ABrokenTailCostsTheBrokenFrameOnly) {
    NEEDS_SHARED_DATA("video");
    const Recording whole = shared_video("copper_h264.mp4");
    const Recording cut = shared_video("copper_h264_truncated.mp4");
    EXPECT_TRUE(has_note(cut.info().notes, "broken_tail"));
    const auto a = whole.read(), b = cut.read();
    const std::vector<std::uint64_t> expected = marks_of(whole, *a), got = marks_of(cut, *b);
    EXPECT_EQ(b->report().decoded, 43);
    EXPECT_EQ(b->report().lost, 1);
    EXPECT_EQ(b->report().first_lost, 41);
    EXPECT_EQ(b->report().reason, "the file ends in the middle of frame 41");
    ASSERT_EQ(got.size(), 44u);
    for (std::size_t i = 0; i < 41; ++i) EXPECT_EQ(got[i], expected[i]) << i;
    EXPECT_EQ(got[41], 0u);
    // The last two were coded before the file broke off: they are frames 42 and 44 of the whole.
    EXPECT_EQ(got[42], expected[42]);
    EXPECT_EQ(got[43], expected[44]);
    EXPECT_NEAR(cut.info().times[43], whole.info().times[44], 1e-9);
}

TEST(VideoData, HashIsThatOfTheFile) {
    NEEDS_SHARED_DATA("video");
    const Recording recording = shared_video("bear-vp9-odd-dimensions.webm");
    const auto file = shared_data() / "video" / "bear-vp9-odd-dimensions.webm";
    EXPECT_EQ(recording.sha256(), sha256_of_file(file));
    std::int64_t last = 0, total = 0;
    recording.sha256([&](std::string_view stage, std::int64_t done, std::int64_t all) {
        EXPECT_EQ(stage, "hash");
        last = done;
        total = all;
        return true;
    });
    EXPECT_EQ(last, std::int64_t(std::filesystem::file_size(file)));
    EXPECT_EQ(total, last);
    const Error stopped = error_of([&] {
        recording.sha256([](std::string_view, std::int64_t, std::int64_t) { return false; });
    });
    EXPECT_EQ(stopped.code(), ErrorCode::interrupted);
}

}  // namespace
}  // namespace verdigris
