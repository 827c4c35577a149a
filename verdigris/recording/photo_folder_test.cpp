// SPDX-License-Identifier: MIT
#include <ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/png.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/scratch.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

using namespace testing;

Image<SrgbU8> solid(int code, int width = 6, int height = 4) {
    Image<SrgbU8> image(width, height);
    for (SrgbU8& p : image.pixels()) p = {std::uint8_t(code), std::uint8_t(code / 2), 3};
    return image;
}

void write_photos(const Scratch& scratch, const std::vector<std::string>& names) {
    int code = 0;
    for (const std::string& name : names) write_png(scratch / name, solid(code += 10));
}

// The red code of each frame, which tells the files apart.
std::vector<int> reds(const Recording& recording) {
    std::vector<int> out;
    const RecordingInfo& info = recording.info();
    const auto reader = recording.read();
    for (Frame frame; reader->next(frame);) {
        EXPECT_EQ(frame.seconds, info.times[std::size_t(frame.index)]);
        const auto image =
            srgb_from_planes(frame.planes, info.format, {0, 0, info.width, info.height});
        out.push_back(u8_from_unit(image(1, 1).r));
    }
    return out;
}

TEST(PhotoFolder, NaturalOrderAndNothingButPictures) {
    const Scratch scratch;
    write_photos(scratch, {"img_2.png", "img_10.png", "img_1.png", ".hidden.png"});
    write_bytes(scratch / "readme.txt", "text");
    write_bytes(scratch / "notes.pdf", "%PDF");
    std::filesystem::create_directory(scratch / "sub.png");
    const Recording recording = open_recording(scratch.path());
    const RecordingInfo& info = recording.info();
    EXPECT_EQ(reds(recording), (std::vector<int>{30, 10, 20}));
    EXPECT_EQ(info.kind, RecordingKind::photographs);
    EXPECT_EQ(info.time_source, TimeSource::file_order);
    EXPECT_EQ(info.times, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(info.codec, "png");
    EXPECT_EQ(info.width, 6);
    EXPECT_EQ(info.height, 4);
    EXPECT_TRUE(has_note(info.notes, "no_times"));
    ASSERT_TRUE(has_note(info.notes, "files_ignored"));
    for (const Status& note : info.notes) {
        if (note.id == "files_ignored") {
            EXPECT_EQ(note.sentence, "1 files that are no pictures are ignored (notes.pdf)");
        }
    }
}

TEST(PhotoFolder, EmptyAndMixedFoldersAreRefused) {
    const Scratch scratch;
    Error error = error_of([&] { open_recording(scratch.path()); });
    EXPECT_EQ(error.sentence(), "has no pictures we can read (PNG, JPEG, TIFF, EXR)");
    write_bytes(scratch / "a.txt", "no picture");
    error = error_of([&] { open_recording(scratch.path()); });
    EXPECT_EQ(error.sentence(), "has no pictures we can read (PNG, JPEG, TIFF, EXR)");
    write_photos(scratch, {"1.png", "2.png"});
    write_png(scratch / "3.png", solid(9, 5, 4));
    write_png(scratch / "4.png", solid(9, 5, 4));
    error = error_of([&] { open_recording(scratch.path()); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(error.where(), (scratch / "3.png").string());
    EXPECT_EQ(error.sentence(),
              "is 5 x 4 pixels, but 1.png is 6 x 4; a recording needs pictures of one size");
}

TEST(PhotoFolder, TimesFromASidecar) {
    const Scratch scratch;
    write_photos(scratch, {"a.png", "b.png", "c.png"});
    const auto table = scratch / "times.csv";
    write_bytes(table,
                "file,time\nb.png,2026-03-01T12:00:30Z\na.png,2026-03-01T12:00:00Z\n"
                "c.png,2026-03-01T13:00:00+01:00\n");
    Recording recording = open_recording(scratch.path());  // c was taken when a was
    EXPECT_EQ(recording.info().time_source, TimeSource::sidecar);
    EXPECT_EQ(recording.info().times, (std::vector<double>{0, 0, 30}));
    EXPECT_EQ(reds(recording), (std::vector<int>{10, 30, 20}));
    EXPECT_TRUE(has_note(recording.info().notes, "times_reordered"));
    EXPECT_TRUE(recording.info().variable_rate);

    write_bytes(table, "frame,time\n0,5\n1,7.5\n2,10\n");
    EXPECT_EQ(open_recording(scratch.path()).info().times, (std::vector<double>{0, 2.5, 5}));

    struct Bad {
        const char *text, *sentence;
        int line;
    };
    for (const Bad& bad :
         {Bad{"file,time\na.png,1\nd.png,2\n", "there is no picture 'd.png' in the folder", 3},
          Bad{"file,time\na.png,1\na.png,2\n", "'a.png' comes twice", 3},
          Bad{"file,time\na.png,1\n", "has no row for 'b.png' and 1 more", 0},
          Bad{"file,when\na.png,1\n", "has no column 'time' in its first line", 0},
          Bad{"frame,time\n0,1\n1,2\n7,3\n",
              "there is no frame 7: the recording has 3, counted from 0", 4},
          Bad{"frame,time\n0,1\nx,2\n", "'x' is not the number of a frame (0, 1, 2 ...)", 3},
          Bad{"time\n0\n1\n", "has 2 times for 3 frames", 0}}) {
        write_bytes(table, bad.text);
        const Error error = error_of([&] { open_recording(scratch.path()); });
        EXPECT_EQ(error.sentence(), bad.sentence);
        EXPECT_EQ(error.where(),
                  table.string() + (bad.line ? ", line " + std::to_string(bad.line) : ""));
    }
    write_bytes(table, "file,time\na.png,3\nb.png,2\nc.png,1\n");
    const Error error = error_of([&] { open_recording(scratch.path()); });
    EXPECT_NE(error.sentence().find("run backwards against the file names in 2 of 2 steps"),
              std::string::npos);
}

TEST(PhotoFolder, MixedTypesBecomeTheWidest) {
    const Scratch scratch;
    write_png(scratch / "1.png", solid(100));
    Image<SrgbU16> deep(6, 4);
    for (SrgbU16& p : deep.pixels()) p = {30000, 20000, 10000};
    write_png(scratch / "2.png", deep);
    Recording recording = open_recording(scratch.path());
    EXPECT_EQ(recording.info().format.type, SampleType::u16);
    EXPECT_EQ(recording.info().format.bits, 16);
    auto reader = recording.read();
    Frame frame;
    ASSERT_TRUE(reader->next(frame));
    const auto* row = reinterpret_cast<const std::uint16_t*>(frame.planes.plane[0].data);
    EXPECT_EQ(row[0], 100 * 257);
    ASSERT_TRUE(reader->next(frame));
    EXPECT_EQ(reinterpret_cast<const std::uint16_t*>(frame.planes.plane[0].data)[1], 20000);

    Image<LinearF> light(6, 4);
    for (LinearF& p : light.pixels()) p = {0.25f, 0.5f, 8.0f};
    write_exr(scratch / "3.exr", ImageView<const LinearF>(light));
    recording = open_recording(scratch.path());
    const RecordingInfo& info = recording.info();
    EXPECT_EQ(info.format.type, SampleType::f32);
    reader = recording.read();
    std::vector<SrgbF> firsts;
    while (reader->next(frame)) {
        firsts.push_back(srgb_from_planes(frame.planes, info.format, {0, 0, 6, 4})(0, 0));
    }
    ASSERT_EQ(firsts.size(), 3u);
    EXPECT_NEAR(firsts[0].r, 100 / 255.0, 1e-6);
    EXPECT_NEAR(firsts[1].r, 30000 / 65535.0, 1e-6);
    EXPECT_NEAR(firsts[2].r, srgb_from_linear(0.25f), 1e-3);  // half floats
    EXPECT_NEAR(firsts[2].b, 1.0f, 1e-6f);
}

TEST(PhotoFolder, BrokenPicturesAreLostAndTheRestKeepTheirPlace) {
    const Scratch scratch;
    write_photos(scratch, {"1.png", "2.png", "3.png", "4.png", "5.png"});
    const std::string bytes = read_bytes(scratch / "3.png");
    write_bytes(scratch / "3.png", bytes.substr(0, bytes.size() - 20));  // the header is whole
    write_bytes(scratch / "4.png", "");
    const Recording recording = open_recording(scratch.path());
    EXPECT_TRUE(has_note(recording.info().notes, "broken_pictures"));
    ASSERT_EQ(recording.info().times.size(), 5u);
    EXPECT_EQ(reds(recording), (std::vector<int>{10, 20, 50}));
    const auto reader = recording.read();
    std::vector<int> indexes;
    for (Frame frame; reader->next(frame);) indexes.push_back(frame.index);
    EXPECT_EQ(indexes, (std::vector<int>{0, 1, 4}));
    EXPECT_EQ(reader->report().lost, 2);
    EXPECT_EQ(reader->report().first_lost, 2);
    EXPECT_EQ(reader->report().reason.rfind("3.png cannot be read: ", 0), 0u);
}

// Our own writer refuses to.
void write_exr_with_nan(const std::filesystem::path& path) {
    std::vector<Imf::Rgba> pixels(24, Imf::Rgba(0.5f, 0.5f, 0.5f));
    pixels[8].g = std::numeric_limits<half>::quiet_NaN();
    Imf::RgbaOutputFile file(path.c_str(), 6, 4, Imf::WRITE_RGB);
    file.setFrameBuffer(pixels.data(), 1, 6);
    file.writePixels(4);
}

TEST(PhotoFolder, NanAndAChangeOfSizeStopTheReading) {
    const Scratch scratch;
    write_exr(scratch / "1.exr", ImageView<const LinearF>(Image<LinearF>(6, 4)));
    write_exr_with_nan(scratch / "2.exr");
    const Recording recording = open_recording(scratch.path());
    auto reader = recording.read();
    Frame frame;
    ASSERT_TRUE(reader->next(frame));
    const Error error = error_of([&] { reader->next(frame); });
    EXPECT_EQ(error.where(), (scratch / "2.exr").string());

    const Scratch other;
    write_photos(other, {"1.png", "2.png"});
    const Recording changed = open_recording(other.path());
    write_png(other / "2.png", solid(1, 9, 9));  // after it was looked at
    reader = changed.read();
    ASSERT_TRUE(reader->next(frame));
    EXPECT_EQ(error_of([&] { reader->next(frame); }).sentence(),
              "is 9 x 9 pixels, but the recording is 6 x 4");
}

TEST(PhotoFolder, SeekAndHash) {
    const Scratch scratch;
    write_photos(scratch, {"1.png", "2.png", "3.png", "4.png", "5.png", "6.png", "7.png"});
    const Recording recording = open_recording(scratch.path());
    const auto reader = recording.read();
    Frame frame;
    for (const int index : {5, 2, 3, 0, 6, 1}) {
        reader->seek(index);
        ASSERT_TRUE(reader->next(frame));
        EXPECT_EQ(frame.index, index);
        EXPECT_EQ(int(frame.planes.plane[0].data[0]), 10 * (index + 1));
    }
    const std::string hash = recording.sha256();
    EXPECT_EQ(hash, open_recording(scratch.path()).sha256());
    std::filesystem::rename(scratch / "7.png", scratch / "8.png");
    const std::string renamed = open_recording(scratch.path()).sha256();
    EXPECT_NE(renamed, hash);
    write_bytes(scratch / "times.csv", "time\n0\n1\n2\n3\n4\n5\n6\n");
    EXPECT_NE(open_recording(scratch.path()).sha256(), renamed);
}

TEST(PhotoFolder, CopperPhotographs) {
    NEEDS_SHARED_DATA("real/copper_patinating");
    const Recording recording = open_recording(shared_data() / "real" / "copper_patinating");
    const RecordingInfo& info = recording.info();
    ASSERT_EQ(info.times.size(), 100u);
    EXPECT_EQ(info.width, 256);
    EXPECT_EQ(info.time_source, TimeSource::file_order);
    const auto reader = recording.read();
    int count = 0;
    for (Frame frame; reader->next(frame); ++count) ASSERT_EQ(frame.index, count);
    EXPECT_EQ(count, 100);
    EXPECT_EQ(reader->report().lost, 0);
}

}  // namespace
}  // namespace verdigris
