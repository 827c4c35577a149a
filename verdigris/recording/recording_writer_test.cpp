// SPDX-License-Identifier: MIT
// What is written is read back by open_recording: the same frames, times and tags.
#include "verdigris/recording/recording_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/scratch.h"
#include "verdigris/recording/testing/written.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

using namespace testing;

// Frame `index` of random pixels: nothing that a codec could guess.
template <class P>
Image<P> noise_frame(int width, int height, int index) {
    Image<P> image(width, height);
    std::mt19937 random{unsigned(index)};
    for (P& p : image.pixels()) {
        p = {decltype(p.r)(random()), decltype(p.g)(random()), decltype(p.b)(random())};
    }
    return image;
}

template <class P>
void expect_lossless(const std::string& name, int width, int height, const std::string& color) {
    SCOPED_TRACE(name + " " + std::to_string(width));
    const Scratch scratch;
    const WriterOptions options{
        .width = width, .height = height, .fps = 25, .bits = 8 * int(sizeof(P) / 3)};
    const int frames = 20;  // more than wait for the folder's compression at once
    const auto writer = write_recording(scratch / name, options);
    for (int i = 0; i < frames; ++i) writer->add(noise_frame<P>(width, height, i));
    EXPECT_FALSE(std::filesystem::exists(scratch / name));
    writer->commit();
    EXPECT_EQ(entry_count(scratch.path()), 1);

    const Recording recording = open_recording(scratch / name);
    const RecordingInfo& info = recording.info();
    EXPECT_EQ(info.width, width);
    EXPECT_EQ(info.height, height);
    EXPECT_EQ(info.format.model, PixelModel::rgb);
    EXPECT_EQ(info.color_description, color);
    EXPECT_FALSE(info.variable_rate);
    EXPECT_TRUE(info.notes.empty()) << info.notes[0].sentence;
    ASSERT_EQ(info.times.size(), std::size_t(frames));
    const auto reader = recording.read();
    Frame frame;
    for (int i = 0; i < frames; ++i) {
        EXPECT_NEAR(info.times[std::size_t(i)], i / 25.0, 1e-9);
        ASSERT_TRUE(reader->next(frame));
        const auto shown = srgb_from_planes(frame.planes, info.format, {0, 0, width, height});
        const auto sent = noise_frame<P>(width, height, i);
        int different = 0;
        for (std::size_t k = 0; k < sent.pixel_count(); ++k) {
            if constexpr (sizeof(P) == 3) {
                different += u8_from_srgb(shown.pixels()[k]) != sent.pixels()[k];
            } else {
                different += u16_from_srgb(shown.pixels()[k]) != sent.pixels()[k];
            }
        }
        EXPECT_EQ(different, 0) << "frame " << i;
    }
    EXPECT_FALSE(reader->next(frame));
    EXPECT_EQ(reader->report().lost, 0);
}

TEST(RecordingWriter, LosslessFormsComeBackBitForBit) {
    // Around the sizes at which FFV1's slices change, and as small as each form goes.
    for (const auto& [width, height] :
         {std::pair{4, 4}, {37, 21}, {353, 4}, {4, 289}, {320, 180}}) {
        expect_lossless<SrgbU8>("clip.mkv", width, height, "RGB full range, 8 bit");
        expect_lossless<SrgbU16>("clip.mkv", width, height, "RGB full range, 16 bit");
    }
    for (const auto& [width, height] : {std::pair{1, 1}, {37, 21}}) {
        expect_lossless<SrgbU8>("clip", width, height, "sRGB");
        expect_lossless<SrgbU16>("clip.d/", width, height, "sRGB");
    }
}

TEST(RecordingWriter, TimesOfAFolderAreExact) {
    const Scratch scratch;
    const auto writer =
        write_recording(scratch / "a", {.width = 2, .height = 2, .fps = 1 / 3600.0});
    for (int i = 0; i < 3; ++i) writer->add(Image<SrgbU8>(2, 2));
    writer->commit();
    EXPECT_EQ(read_bytes(scratch / "a/times.csv"),
              "file,time\n000000.png,0\n000001.png,3600\n000002.png,7200\n");
    const RecordingInfo info = open_recording(scratch / "a").info();
    EXPECT_EQ(info.time_source, TimeSource::sidecar);
    EXPECT_EQ(info.times, (std::vector<double>{0, 3600, 7200}));
}

TEST(RecordingWriter, TimesOfAVideoAreThoseOfItsRate) {
    NEEDS_X264();
    const Scratch scratch;
    // What each container's clock can say: ticks of the rate itself, or milliseconds.
    for (const double fps : {24.0, 30000 / 1001.0, 59.94, 1000.0, 0.1, 1 / 86400.0}) {
        for (const char* name : {"a.mp4", "a.mkv"}) {
            const auto writer = write_recording(
                scratch / name, {.width = 16, .height = 16, .fps = fps, .replace = true});
            for (int i = 0; i < 30; ++i) writer->add(noise_frame<SrgbU8>(16, 16, i));
            writer->commit();
            const RecordingInfo info = open_recording(scratch / name).info();
            EXPECT_FALSE(info.variable_rate) << name << " " << fps;
            EXPECT_TRUE(info.notes.empty()) << name << " " << fps << info.notes[0].sentence;
            ASSERT_EQ(info.times.size(), 30u);
            const double tick = std::string(name) == "a.mkv" ? 0.0005 : 1e-6;
            for (int i = 0; i < 30; ++i) {
                EXPECT_NEAR(info.times[std::size_t(i)], i / fps, tick + 1e-9 * i / fps)
                    << name << " " << fps;
            }
        }
    }
}

// Patches of 64 x 64: a gray ramp above, colors below, copper and patina among them. Red and blue
// run through 16 codes in each, so that rounding to codes averages out and a shift does not.
Image<SrgbU8> patches() {
    const std::array<SrgbU8, 8> colors{{{184, 115, 51},
                                        {67, 130, 110},
                                        {200, 40, 40},
                                        {40, 200, 40},
                                        {40, 40, 200},
                                        {240, 230, 20},
                                        {12, 12, 12},
                                        {240, 245, 240}}};
    Image<SrgbU8> image(512, 128);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 512; ++x) {
            const auto gray = std::uint8_t(x / 2);
            SrgbU8 color = colors[std::size_t(x / 64)];
            color.r = std::uint8_t(color.r + x % 64 / 4 - 8);
            color.b = std::uint8_t(color.b + y % 64 / 4 - 8);
            image(x, y) = y < 64 ? SrgbU8{gray, gray, gray} : color;
        }
    }
    return image;
}

TEST(RecordingWriter, H264KeepsColorsAndSaysHowTheyAreCoded) {
    NEEDS_X264();
    const Scratch scratch;
    const auto sent = patches();
    const auto writer = write_recording(scratch / "a.MP4", {.width = 512, .height = 128});
    for (int i = 0; i < 10; ++i) writer->add(sent);
    writer->commit();
    const Recording recording = open_recording(scratch / "a.MP4");
    EXPECT_EQ(recording.info().color_description, "BT.709 limited range, 8 bit");
    EXPECT_EQ(recording.info().format.chroma_x, 0);
    EXPECT_EQ(recording.info().format.chroma_y, 0.5);
    EXPECT_TRUE(recording.info().notes.empty());
    ASSERT_EQ(recording.info().times.size(), 10u);
    const auto reader = recording.read();
    Frame frame;
    int read = 0;
    for (; reader->next(frame); ++read) {
        const auto shown =
            srgb_from_planes(frame.planes, recording.info().format, {0, 0, 512, 128});
        // Patch by patch, without 4 pixels at its edges, where 4:2:0 mixes colors.
        for (int patch = 0; patch < 16; ++patch) {
            std::array<double, 3> signed_error{};
            const int left = patch % 8 * 64, top = patch / 8 * 64;
            for (int y = top + 4; y < top + 60; ++y) {
                for (int x = left + 4; x < left + 60; ++x) {
                    const SrgbF c = shown(x, y);
                    const SrgbU8 s = sent(x, y);
                    signed_error[0] += (255 * c.r - s.r) / (56 * 56);
                    signed_error[1] += (255 * c.g - s.g) / (56 * 56);
                    signed_error[2] += (255 * c.b - s.b) / (56 * 56);
                }
            }
            for (const double e : signed_error) EXPECT_LT(std::abs(e), 0.5) << "patch " << patch;
        }
    }
    EXPECT_EQ(read, 10);
}

TEST(RecordingWriter, SameFramesSameBytesOnAnyNumberOfCores) {
    const Scratch scratch;
    for (const std::string name : {"a.mp4", "a.mkv", "a/"}) {
        if (name == "a.mp4" && !have_x264()) continue;
        std::vector<std::string> bytes;
        for (const int cores : {0, 1, 0}) {
            const OnCores limit(cores);
            const auto target = scratch / (std::to_string(bytes.size()) + name);
            const auto writer = write_recording(target, {.width = 320, .height = 240});
            for (int i = 0; i < 70; ++i) writer->add(noise_frame<SrgbU8>(320, 240, i / 2));
            writer->commit();
            bytes.push_back(name == "a/" ? read_bytes(target / "000069.png") +
                                               read_bytes(target / "times.csv")
                                         : read_bytes(target));
        }
        EXPECT_TRUE(bytes[0] == bytes[1]) << name;
        EXPECT_TRUE(bytes[0] == bytes[2]) << name;
        for (const char* mark : {"x264", "Lavf5", "Lavc", "core 1"}) {
            EXPECT_EQ(bytes[0].find(mark), std::string::npos) << name << " " << mark;
        }
    }
}

}  // namespace
}  // namespace verdigris
