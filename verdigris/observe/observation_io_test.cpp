// SPDX-License-Identifier: MIT
#include "verdigris/observe/observation_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/npy.h"
#include "verdigris/files/png.h"
#include "verdigris/files/testing.h"
#include "verdigris/observe/testing/made_scene.h"
#include "verdigris/recording/memory_recording.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/made_video.h"

namespace verdigris {
namespace {

class ObservationIo : public ::testing::Test {
  protected:
    Observation made(bool stored) const {
        testing::MadeScene scene;
        scene.width = 64;
        scene.height = 48;
        scene.center_x = 30;
        scene.center_y = 24;
        scene.plate_width = 30;
        scene.plate_height = 24;
        scene.glint = true;
        std::vector<double> times;
        for (int i = 0; i < 12; ++i) times.push_back(i < 9 ? i : i + 2);
        ObserveOptions options;
        options.crop.mode = CropMode::none;
        if (stored) options.store = folder_ / "samples.npy";
        return observe(
            recording_from_function(64, 48, times, [=](int i) { return scene.frame(i, 12); }),
            options);
    }
    std::string refusal() const {
        try {
            read_observation(folder_);
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::bad_input);
            return e.what();
        }
        return "";
    }
    ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_.path();
};

void expect_equal(const Observation& a, const Observation& b) {
    EXPECT_EQ(a.source_name, b.source_name);
    EXPECT_EQ(a.source_sha256, b.source_sha256);
    EXPECT_EQ(a.axis.units, b.axis.units);
    EXPECT_EQ(a.axis.samples, b.axis.samples);
    EXPECT_EQ(a.axis.samples_per_unit, b.axis.samples_per_unit);
    EXPECT_EQ(a.axis.seconds_per_unit, b.axis.seconds_per_unit);
    ASSERT_EQ(a.samples.size(), b.samples.size());
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
        EXPECT_EQ(a.samples[i].unit, b.samples[i].unit);
        EXPECT_EQ(a.samples[i].seconds, b.samples[i].seconds);
        EXPECT_EQ(a.samples[i].frames, b.samples[i].frames);
        EXPECT_EQ(a.samples[i].interpolated, b.samples[i].interpolated);
    }
    EXPECT_EQ(a.noise.sigma, b.noise.sigma);
    EXPECT_EQ(a.noise.tau, b.noise.tau);
    EXPECT_EQ(a.crop.rect, b.crop.rect);
    EXPECT_EQ(a.crop.sentence, b.crop.sentence);
    EXPECT_EQ(a.crop.area_share, b.crop.area_share);
    EXPECT_EQ(a.decode.decoded, b.decode.decoded);
    EXPECT_EQ(a.decode.first_lost, b.decode.first_lost);
    ASSERT_EQ(a.notes.size(), b.notes.size());
    for (std::size_t i = 0; i < a.notes.size(); ++i) {
        EXPECT_EQ(a.notes[i].id, b.notes[i].id);
        EXPECT_EQ(a.notes[i].severity, b.notes[i].severity);
        EXPECT_EQ(a.notes[i].sentence, b.notes[i].sentence);
    }
    ASSERT_EQ(a.store->count(), b.store->count());
    for (int i = 0; i < a.store->count(); ++i) {
        const Image<SrgbF> p = a.store->image(i), q = b.store->image(i);
        ASSERT_TRUE(p.same_size(q));
        EXPECT_EQ(std::memcmp(p.row(0), q.row(0), p.byte_count()), 0);
    }
    for (const auto& [p, q] : {std::pair{&a.specimen, &b.specimen}, {&a.clipped, &b.clipped}}) {
        ASSERT_TRUE(p->same_size(*q));
        EXPECT_EQ(std::memcmp(p->row(0), q->row(0), p->byte_count()), 0);
    }
}

TEST_F(ObservationIo, ComesBackAsItWas) {
    for (const bool stored : {false, true}) {
        const Observation written = made(stored);
        EXPECT_FALSE(written.notes.empty());
        write_observation(written, folder_);
        expect_equal(written, read_observation(folder_));
    }
    // Overwriting an observation with what was read from it is no trouble.
    write_observation(read_observation(folder_), folder_);
    expect_equal(made(false), read_observation(folder_));
}

// Video is stored as the planes it was coded in; resampled video as color.
TEST_F(ObservationIo, OfVideoComesBackAsItWas) {
    if (!testing::have_ffmpeg()) GTEST_SKIP() << "the ffmpeg program makes the video";
    const std::filesystem::path clip = folder_ / "clip.mkv";
    ASSERT_TRUE(testing::make_pattern(clip, 24, 8, "-c:v ffv1"));
    for (const int size : {0, 90}) {
        ObserveOptions options;
        options.crop.mode = CropMode::manual;
        options.crop.rect = {31, 17, 201, 133};
        options.size = size;
        const Observation temporary = observe(open_recording(clip), options);
        options.store = folder_ / "samples.npy";
        const Observation written = observe(open_recording(clip), options);
        write_observation(written, folder_);
        expect_equal(temporary, written);
        expect_equal(written, read_observation(folder_));
        const NpyFile npy(folder_ / "samples.npy");
        EXPECT_EQ(npy.shape().size(), size == 0 ? 2u : 4u);
        EXPECT_EQ(npy.shape()[0], 24u);
        // Elsewhere it becomes color, whatever it was.
        const std::filesystem::path copy = folder_ / "copy";
        std::filesystem::create_directories(copy);
        write_observation(temporary, copy);
        const Observation back = read_observation(copy);
        EXPECT_EQ(NpyFile(copy / "samples.npy").shape().size(), 4u);
        const Image<SrgbF> a = written.store->image(23), b = back.store->image(23);
        for (std::size_t i = 0; i < a.pixel_count(); ++i) {
            ASSERT_NEAR(a.pixels()[i].g, b.pixels()[i].g, 0.51 / 65535);
        }
    }
}

// FFmpeg makes FFV1 of photographs as bgr0, other coders as planes of green, blue and red.
TEST_F(ObservationIo, OfRgbVideoInAnyOrderIsTheSame) {
    if (!testing::have_ffmpeg()) GTEST_SKIP() << "the ffmpeg program makes the video";
    Image<SrgbF> expected;
    for (const std::string order : {"rgb24", "bgr0", "bgra", "gbrp", "gbrp10le", "gbrp16le"}) {
        const std::filesystem::path clip = folder_ / (order + ".mkv");
        const std::string codec = order == "rgb24" ? "-c:v png" : "-c:v ffv1";
        // Drawn as rgb24 every time: only the order and the depth of the planes differ.
        ASSERT_TRUE(testing::make_pattern(
            clip, 6, 3,
            codec + " -vf format=rgb24,noise=alls=6:allf=t,format=" + order + " -pix_fmt " + order))
            << order;
        ObserveOptions options;
        options.crop.mode = CropMode::none;
        const Observation o = observe(open_recording(clip), options);
        const Image<SrgbF> last = o.store->image(o.store->count() - 1);
        if (expected.empty()) expected = last.clone();
        ASSERT_TRUE(last.same_size(expected));
        double worst = 0;
        for (std::size_t i = 0; i < last.pixel_count(); ++i) {
            const SrgbF a = last.pixels()[i], b = expected.pixels()[i];
            for (auto c : {&SrgbF::r, &SrgbF::g, &SrgbF::b}) {
                worst = std::max(worst, std::fabs(double(a.*c) - double(b.*c)));
            }
        }
        if (order.size() <= 5) {
            EXPECT_LE(worst, 1e-6) << order;
            continue;
        }
        // FFmpeg's way to more bits changes colors (by up to 7 % in 16 bit), so the deeper ones are
        // held to its own reading of the same file.
        const std::filesystem::path raw = folder_ / (order + ".raw");
        ASSERT_TRUE(testing::run_ffmpeg("-i " + clip.string() + " -f rawvideo -pix_fmt rgb48le " +
                                        raw.string()));
        const std::string bytes = read_text(raw);
        const std::size_t size = 6 * last.pixel_count();
        ASSERT_EQ(bytes.size() % size, 0u);
        const char* at = bytes.data() + bytes.size() - size;
        double apart = 0;
        for (const SrgbF& c : last.pixels()) {
            for (const float v : {c.r, c.g, c.b}) {
                std::uint16_t code = 0;
                std::memcpy(&code, at, 2);
                at += 2;
                apart = std::max(apart, std::fabs(double(v) - code / 65535.0));
            }
        }
        EXPECT_LE(apart, 2.0 / 65535) << order;
    }
}

TEST_F(ObservationIo, NamesTheFileThatIsMissingOrBroken) {
    EXPECT_NE(refusal().find("observation.json"), std::string::npos);
    write_observation(made(false), folder_);
    ASSERT_EQ(refusal(), "");
    const std::string json = read_text(folder_ / "observation.json");

    std::ofstream(folder_ / "observation.json") << json.substr(0, json.size() / 2);
    EXPECT_NE(refusal().find("observation.json"), std::string::npos);
    std::ofstream(folder_ / "observation.json") << "[1, 2]";
    EXPECT_NE(refusal().find("is not an observation"), std::string::npos);
    std::string newer = json;
    newer.replace(newer.find("\"version\": 2"), 12, "\"version\": 9");
    std::ofstream(folder_ / "observation.json") << newer;
    EXPECT_NE(refusal().find("newer"), std::string::npos);
    std::string wide = json;
    wide.replace(wide.find("\"width\": 64"), 11, "\"width\": 65");
    std::ofstream(folder_ / "observation.json") << wide;
    EXPECT_NE(refusal().find("samples.npy"), std::string::npos);
    std::string axis = json;
    axis.replace(axis.find("\"samples_per_unit\": 1"), 21, "\"samples_per_unit\": 0");
    std::ofstream(folder_ / "observation.json") << axis;
    EXPECT_NE(refusal().find("time axis"), std::string::npos);
    std::string severity = json;
    const std::string known = "\"severity\": \"info\"";
    ASSERT_NE(severity.find(known), std::string::npos) << json;
    severity.replace(severity.find(known), known.size(), "\"severity\": \"dire\"");
    std::ofstream(folder_ / "observation.json") << severity;
    EXPECT_NE(refusal().find("unknown severity 'dire'"), std::string::npos);
    std::ofstream(folder_ / "observation.json") << json;
    ASSERT_EQ(refusal(), "");

    const auto size = std::filesystem::file_size(folder_ / "samples.npy");
    std::filesystem::resize_file(folder_ / "samples.npy", size - 100);
    EXPECT_NE(refusal().find("samples.npy"), std::string::npos);
    write_npy(folder_ / "samples.npy", NpyType::u8, {12, 48, 64, 3},
              std::vector<std::byte>(12 * 48 * 64 * 3));
    EXPECT_NE(refusal().find("samples.npy"), std::string::npos);
    std::filesystem::remove(folder_ / "samples.npy");
    EXPECT_NE(refusal().find("samples.npy"), std::string::npos);

    write_observation(made(false), folder_);
    write_png(folder_ / "clipped.png", Mask(5, 5));
    EXPECT_NE(refusal().find("clipped.png"), std::string::npos);
    std::filesystem::remove(folder_ / "specimen.png");
    EXPECT_NE(refusal().find("specimen.png"), std::string::npos);
}

}  // namespace
}  // namespace verdigris
