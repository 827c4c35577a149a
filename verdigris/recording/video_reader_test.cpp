// SPDX-License-Identifier: MIT
// Seeking, damage, threads, and files that are no videos.
#include "verdigris/recording/video_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/made_video.h"

namespace verdigris {
namespace {

using namespace testing;

struct Kind {
    const char *encoder, *arguments, *file;
};
// B-frames, open groups, hidden frames: what makes decoding order differ from showing order.
const Kind kKinds[] = {
    {"libx264", "-c:v libx264 -preset fast -bf 3", "a.mp4"},
    {"libx264", "-c:v libx264 -preset fast -x264-params open-gop=1", "b.mkv"},
    {"libx265", "-c:v libx265 -preset ultrafast -bf 3 -x265-params log-level=none", "c.mp4"},
    {"libvpx-vp9", "-c:v libvpx-vp9 -deadline realtime -cpu-used 8", "d.webm"},
    {"mpeg4", "-c:v mpeg4 -bf 2 -q:v 4", "e.mp4"},
    {"mpeg4", "-c:v mpeg4 -bf 2 -q:v 4", "f.avi"},
    {"mpeg2video", "-c:v mpeg2video -bf 2 -q:v 4", "g.ts"},
    {"libx264", "-c:v libx264 -preset fast", "g2.ts"},
    {"mjpeg", "-c:v mjpeg", "h.avi"},
    {"ffv1", "-c:v ffv1", "i.mkv"},
};

TEST(VideoReader, SeekingGivesTheFramesOfReadingThrough) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    for (const Kind& kind : kKinds) {
        SCOPED_TRACE(std::string(kind.arguments) + " " + kind.file);
        if (!have_encoder(kind.encoder)) continue;
        ASSERT_TRUE(make_pattern(scratch / kind.file, 60, 12, kind.arguments));
        const Recording recording = open_recording(scratch / kind.file);
        const auto through = recording.read();
        const std::vector<std::uint64_t> marks = marks_of(recording, *through);
        ASSERT_EQ(marks.size(), 60u);
        EXPECT_EQ(through->report().lost, 0) << through->report().reason;
        std::mt19937 random(11);
        const auto reader = recording.read();
        Frame frame;
        for (int trial = 0; trial < 40; ++trial) {
            const int index = int(random() % 60);
            reader->seek(index);
            for (int i = index; i < std::min(index + 3, 60); ++i) {
                ASSERT_TRUE(reader->next(frame)) << "seek " << index;
                ASSERT_EQ(frame.index, i) << "seek " << index;
                ASSERT_EQ(mark_of(frame.planes), marks[std::size_t(i)]) << "seek " << index;
            }
        }
        EXPECT_EQ(reader->report().lost, 0);
        reader->seek(60);
        EXPECT_FALSE(reader->next(frame));
        reader->seek(0);
        ASSERT_TRUE(reader->next(frame));
        EXPECT_EQ(frame.index, 0);
    }
}

TEST(VideoReader, SameFramesOnAnyNumberOfThreads) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    ASSERT_TRUE(make_pattern(scratch / "a.mp4", 40, 15, "-c:v libx264 -preset fast"));
    std::vector<std::uint64_t> first;
    for (const int threads : {1, 2, 5}) {
        RecordingOptions options;
        options.decode_threads = threads;
        const Recording recording = open_recording(scratch / "a.mp4", options);
        const auto reader = recording.read();
        const std::vector<std::uint64_t> marks = marks_of(recording, *reader);
        if (first.empty()) first = marks;
        EXPECT_EQ(marks, first) << threads << " threads";
    }
}

TEST(VideoReader, FramesOutliveTheReader) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    ASSERT_TRUE(make_pattern(scratch / "a.mp4", 20, 10, "-c:v libx264 -preset fast"));
    std::vector<Frame> frames;
    std::vector<std::uint64_t> marks;
    {
        const Recording recording = open_recording(scratch / "a.mp4");
        const auto reader = recording.read();
        for (Frame frame; reader->next(frame);) {
            marks.push_back(mark_of(frame.planes));
            frames.push_back(frame);
        }
    }
    ASSERT_EQ(frames.size(), 20u);
    for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(mark_of(frames[i].planes), marks[i]);
}

// Damage to every packet in turn: what comes out has its own index and its own pixels, and what
// is gone is counted. H.264 finds nearly all damage; a frame may differ unseen only where the
// decoder cannot know (the codes still parse).
TEST(VideoReader, DamageLosesFramesWithoutShiftingTheRest) {
    NEEDS_FFMPEG();
    if (!have_encoder("libx264")) GTEST_SKIP() << "this ffmpeg has no libx264";
    const Scratch scratch;
    const auto file = scratch / "a.mp4", damaged = scratch / "b.mp4";
    ASSERT_TRUE(make_pattern(file, 60, 20, "-c:v libx264 -preset fast"));
    const Recording whole = open_recording(file);
    const auto reader = whole.read();
    const std::vector<std::uint64_t> expected = marks_of(whole, *reader);
    VideoContainer container = open_container(file);
    const VideoIndex index = index_packets(container);
    const std::string bytes = read_bytes(file);
    int losses = 0, unseen = 0;
    for (std::size_t p = 0; p + 1 < index.packets.size(); p += 3) {
        std::string broken = bytes;
        const std::size_t begin = std::size_t(index.packets[p].pos);
        const std::size_t end = std::min(std::size_t(index.packets[p + 1].pos), broken.size());
        for (std::size_t i = begin + 8; i < end; ++i) broken[i] = char(broken[i] ^ 0x5a);
        write_bytes(damaged, broken);
        const Recording recording = open_recording(damaged);
        ASSERT_EQ(recording.info().times.size(), 60u);
        const auto careful = recording.read();
        const std::vector<std::uint64_t> marks = marks_of(recording, *careful);
        int lost = 0;
        for (std::size_t i = 0; i < 60; ++i) {
            lost += marks[i] == 0;
            unseen += marks[i] != 0 && marks[i] != expected[i];
        }
        const DecodeReport& report = careful->report();
        EXPECT_EQ(report.lost, lost);
        EXPECT_EQ(report.decoded, 60 - lost);
        EXPECT_LE(lost, 20 + 4) << "damage must not reach beyond its group";
        if (lost > 0) {
            ++losses;
            EXPECT_EQ(marks[std::size_t(report.first_lost)], 0u);
            EXPECT_NE(report.reason.find("is damaged"), std::string::npos) << report.reason;
        }
    }
    EXPECT_GE(losses, 18) << "of 20 damaged files";
    EXPECT_LE(unseen, 20);
}

// Damage is found, or not, regardless of the threads; FFV1 knows all of it by checksum.
TEST(VideoReader, DamageIsTheSameOnAnyNumberOfThreads) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    for (const Kind& kind : {Kind{"libx264", "-c:v libx264 -preset fast", "a.mp4"},
                             Kind{"ffv1", "-c:v ffv1 -level 3 -slicecrc 1", "b.mkv"}}) {
        if (!have_encoder(kind.encoder)) continue;
        const auto file = scratch / kind.file;
        ASSERT_TRUE(make_pattern(file, 40, 10, kind.arguments));
        const Recording whole = open_recording(file);
        const auto reader = whole.read();
        const std::vector<std::uint64_t> expected = marks_of(whole, *reader);
        VideoContainer container = open_container(file);
        const VideoIndex index = index_packets(container);
        std::string bytes = read_bytes(file);
        for (const std::size_t p : {5u, 22u}) {
            const std::size_t middle =
                std::size_t(index.packets[p].pos + index.packets[p + 1].pos) / 2;
            for (std::size_t i = middle; i < middle + 6; ++i) bytes[i] = char(bytes[i] ^ 0x35);
        }
        write_bytes(file, bytes);
        std::vector<std::uint64_t> first;
        for (const int threads : {1, 2, 3, 2, 8}) {
            RecordingOptions options;
            options.decode_threads = threads;
            const Recording recording = open_recording(file, options);
            const auto damaged = recording.read();
            const std::vector<std::uint64_t> marks = marks_of(recording, *damaged);
            if (first.empty()) first = marks;
            EXPECT_EQ(marks, first) << threads << " threads";
            if (std::string(kind.encoder) == "ffv1") {
                EXPECT_EQ(damaged->report().lost, 5 + 8);  // up to the next key frames, 10 and 30
                for (std::size_t i = 0; i < 40; ++i) {
                    EXPECT_EQ(marks[i], marks[i] ? expected[i] : 0u);
                }
            }
        }
    }
}

// MPEG-4 part 2: FFmpeg ends the process if it is asked to fail on such damage.
TEST(VideoReader, DamageNeverEndsTheProcess) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    for (const Kind& kind : kKinds) {
        SCOPED_TRACE(std::string(kind.arguments) + " " + kind.file);
        if (!have_encoder(kind.encoder)) continue;
        const auto file = scratch / kind.file;
        ASSERT_TRUE(make_pattern(file, 30, 10, kind.arguments));
        const std::string bytes = read_bytes(file);
        std::mt19937 random(21);
        for (int trial = 0; trial < 8; ++trial) {
            std::string broken = bytes;
            for (int i = 0; i < 40; ++i) {
                broken[4096 + random() % (broken.size() - 4096)] = char(random());
            }
            if (trial % 3 == 2) broken.resize(broken.size() / 2 + random() % (broken.size() / 2));
            write_bytes(file, broken);
            try {
                const Recording recording = open_recording(file);
                const auto reader = recording.read();
                const std::vector<std::uint64_t> marks = marks_of(recording, *reader);
                const auto lost = std::count(marks.begin(), marks.end(), 0u);
                EXPECT_EQ(reader->report().lost, lost);
                EXPECT_EQ(reader->report().decoded + lost, std::ptrdiff_t(marks.size()));
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::bad_input) << error.what();
            }
        }
    }
}

// Matroska says how long all of it is, and nothing of its video.
TEST(VideoReader, AVideoThatIsCutOffIsSaidToBe) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    for (const Kind& kind : {Kind{"ffv1", "-c:v ffv1", "whole.mkv"},
                             Kind{"libvpx-vp9", "-c:v libvpx-vp9 -cpu-used 8", "whole.webm"},
                             Kind{"mpeg4", "-c:v mpeg4 -q:v 4", "whole.avi"}}) {
        SCOPED_TRACE(kind.file);
        if (!have_encoder(kind.encoder)) continue;
        ASSERT_TRUE(make_pattern(scratch / kind.file, 80, 10, kind.arguments));
        const std::string bytes = read_bytes((scratch / kind.file).string());
        EXPECT_FALSE(has_note(open_recording(scratch / kind.file).info().notes, "broken_tail"));
        const auto cut = scratch / (std::string("cut-") + kind.file);
        write_bytes(cut, bytes.substr(0, bytes.size() / 2));
        EXPECT_TRUE(has_note(open_recording(cut).info().notes, "broken_tail"));
    }
}

TEST(VideoReader, AChangeOfSizeIsNamedWithItsFrame) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    const auto a = (scratch / "a.ts").string(), b = (scratch / "b.ts").string();
    ASSERT_TRUE(run_ffmpeg("-f lavfi -i testsrc2=s=320x180:r=10:d=1 -c:v mpeg2video " + a));
    ASSERT_TRUE(
        run_ffmpeg("-f lavfi -i testsrc2=s=160x96:r=10:d=1 -output_ts_offset 1 "
                   "-c:v mpeg2video " +
                   b));
    write_bytes(scratch / "c.ts", read_bytes(a) + read_bytes(b));
    const Recording recording = open_recording(scratch / "c.ts");
    const auto reader = recording.read();
    const Error error = error_of([&] {
        for (Frame frame; reader->next(frame);) {
        }
    });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_NE(error.sentence().find("160 x 96"), std::string::npos) << error.what();
    EXPECT_NE(error.where().find("frame "), std::string::npos) << error.what();
}

}  // namespace
}  // namespace verdigris
