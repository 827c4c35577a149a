// SPDX-License-Identifier: MIT
// Files that cannot be used are refused in one sentence; times come from where they should.
#include <gtest/gtest.h>

#include <string>

#include "verdigris/files/png.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/made_video.h"

namespace verdigris {
namespace {

using namespace testing;

void expect_refused(const std::filesystem::path& path, const std::string& words) {
    const Error error = error_of([&] { open_recording(path); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input) << error.what();
    EXPECT_NE(error.sentence().find(words), std::string::npos) << error.what();
    EXPECT_EQ(error.where(), path.string());
}

TEST(OpenRecording, WhatIsNoVideoIsRefusedInASentence) {
    const Scratch scratch;
    expect_refused(scratch / "missing.mp4", "there is no such file or folder");
    expect_refused("/dev/null", "is neither a file nor a folder");
    write_bytes(scratch / "empty.mp4", "");
    expect_refused(scratch / "empty.mp4", "the file is empty");
    write_bytes(scratch / "text.mp4", "This is a letter, not a video.\nIt has two lines.\n");
    expect_refused(scratch / "text.mp4", "is not a video that can be read");
    write_bytes(scratch / "text.txt", std::string(5000, 'a'));
    expect_refused(scratch / "text.txt", "is not a video that can be read");
    write_bytes(scratch / "list.m3u8", "#EXTM3U\n#EXTINF:1,\nother.ts\n");
    expect_refused(scratch / "list.m3u8", "is not a video that can be read");
    write_png(scratch / "frame.png", Image<SrgbU8>(4, 4));
    expect_refused(scratch / "frame.png",
                   "is one picture; a recording needs a folder of them or a video");
}

TEST(OpenRecording, BrokenContainersAreRefusedInASentence) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    ASSERT_TRUE(make_pattern(scratch / "a.mp4", 10, 5, "-c:v mpeg4"));
    const std::string bytes = read_bytes(scratch / "a.mp4");
    write_bytes(scratch / "b.mp4", bytes.substr(0, bytes.size() / 2));  // its index is at the end
    expect_refused(scratch / "b.mp4", "the file is incomplete: its index is missing (moov atom)");

    ASSERT_TRUE(run_ffmpeg("-f lavfi -i sine=d=1 " + (scratch / "sound.mp4").string()));
    expect_refused(scratch / "sound.mp4", "holds sound but no video");
    ASSERT_TRUE(run_ffmpeg("-f lavfi -i sine=d=1 " + (scratch / "sound.wav").string()));
    expect_refused(scratch / "sound.wav", "is not a video that can be read");
    ASSERT_TRUE(run_ffmpeg("-f lavfi -i testsrc2=s=64x64:d=1 -frames:v 0 -c:v mpeg4 " +
                           (scratch / "none.avi").string()));
    EXPECT_THROW(open_recording(scratch / "none.avi"), Error);
    ASSERT_TRUE(run_ffmpeg("-i " + (scratch / "a.mp4").string() +
                           " -c copy -encryption_scheme cenc-aes-ctr -encryption_key "
                           "00112233445566778899aabbccddeeff -encryption_kid "
                           "00112233445566778899aabbccddeeff " +
                           (scratch / "e.mp4").string()));
    expect_refused(scratch / "e.mp4", "is encrypted");
}

TEST(OpenRecording, OddNamesAreNames) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    ASSERT_TRUE(make_pattern(scratch / "a.mp4", 10, 5, "-c:v mpeg4"));
    for (const char* name : {"http:a.mp4", "a b %d.mp4", "-i.mp4", "\xc3\xa4.mp4"}) {
        std::filesystem::copy_file(scratch / "a.mp4", scratch / name);
        EXPECT_EQ(open_recording(scratch / name).info().times.size(), 10u) << name;
    }
}

std::string times_table(int rows, const std::string& head, double step, bool numbered) {
    std::string text = head + "\n";
    for (int i = 0; i < rows; ++i) {
        text += (numbered ? std::to_string(i) + "," : "") + std::to_string(100 + step * i) + "\n";
    }
    return text;
}

TEST(OpenRecording, SidecarOfAVideo) {
    NEEDS_FFMPEG();
    const Scratch scratch;
    const auto video = scratch / "a.mp4", own = scratch / "a.mp4.times.csv";
    ASSERT_TRUE(make_pattern(video, 10, 5, "-c:v mpeg4"));
    write_bytes(scratch / "times.csv", times_table(10, "frame,time", 60, true));
    Recording recording = open_recording(video);
    EXPECT_EQ(recording.info().time_source, TimeSource::sidecar);
    EXPECT_EQ(recording.info().times[9], 540);
    EXPECT_EQ(recording.info().times[0], 0);
    const auto reader = recording.read();
    Frame frame;
    reader->seek(3);
    ASSERT_TRUE(reader->next(frame));
    EXPECT_EQ(frame.seconds, 180);

    write_bytes(own, times_table(10, "time", 5, false));  // its own table comes first
    EXPECT_EQ(open_recording(video).info().times[9], 45);

    std::filesystem::remove(own);
    write_bytes(scratch / "times.csv", times_table(7, "frame,time", 60, true));
    recording = open_recording(video);  // belongs to something else
    EXPECT_EQ(recording.info().time_source, TimeSource::container);
    EXPECT_TRUE(has_note(recording.info().notes, "sidecar_ignored"));

    write_bytes(own, times_table(7, "frame,time", 60, true));
    Error error = error_of([&] { open_recording(video); });
    EXPECT_EQ(error.where(), own.string());
    EXPECT_EQ(error.sentence(), "has no row for frame 7 and 2 more");
    write_bytes(own, times_table(10, "frame,time", -1, true));
    error = error_of([&] { open_recording(video); });
    EXPECT_NE(error.sentence().find("run backwards in 9 places"), std::string::npos);
    write_bytes(own, "frame,time\n0,1\n1,noon\n");
    error = error_of([&] { open_recording(video); });
    EXPECT_EQ(error.where(), own.string() + ", line 3");
}

}  // namespace
}  // namespace verdigris
