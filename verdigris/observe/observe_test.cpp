// SPDX-License-Identifier: MIT
#include "verdigris/observe/observe.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/observe/testing/made_scene.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/memory_recording.h"

namespace verdigris {
namespace {

using testing::MadeScene;

std::vector<double> even_times(int frames, double step = 1) {
    std::vector<double> times;
    for (int i = 0; i < frames; ++i) times.push_back(i * step);
    return times;
}

Recording recording_of(const MadeScene& scene, int frames) {
    return recording_from_function(scene.width, scene.height, even_times(frames),
                                   [=](int i) { return scene.frame(i, frames); });
}

ObserveOptions with_crop(CropChoice crop) {
    ObserveOptions options;
    options.crop = crop;
    return options;
}

bool has(const Statuses& notes, const std::string& id) {
    return std::any_of(notes.begin(), notes.end(), [&](const Status& s) { return s.id == id; });
}

// A tenth of the default: one frame per sample.
MadeScene small_scene() {
    MadeScene scene;
    scene.width = 160;
    scene.height = 120;
    scene.center_x = 75;
    scene.center_y = 62;
    scene.plate_width = 64;
    scene.plate_height = 50;
    return scene;
}

TEST(Observe, CropsDenoisesAndMeasures) {
    MadeScene scene = small_scene();
    scene.tilt_degrees = 4;
    scene.noise = 3.4 / 255;
    const Observation o = observe(recording_of(scene, 60));
    EXPECT_EQ(o.axis.samples, 60);
    EXPECT_DOUBLE_EQ(o.axis.units, 60);
    ASSERT_EQ(o.samples.size(), 60u);
    EXPECT_EQ(o.store->count(), 60);
    EXPECT_DOUBLE_EQ(o.samples[0].unit, 0.5);
    EXPECT_EQ(o.samples[7].frames, 1);
    EXPECT_EQ(o.crop.rect.width, o.crop.rect.height);
    EXPECT_EQ(o.width(), o.crop.rect.width);
    // sigma of one frame: the camera's, and 8-bit rounding.
    EXPECT_NEAR(o.noise.sigma, std::sqrt(3.4 * 3.4 + 1 / 12.0) / 255, 4e-4);
    EXPECT_NEAR(o.noise.tau, 2.40 * o.noise.sigma, 1e-12);
    Mask truth(o.width(), o.height());
    for (int y = 0; y < o.height(); ++y) {
        for (int x = 0; x < o.width(); ++x) {
            truth(x, y) =
                scene.on_plate(x + o.crop.rect.x, y + o.crop.rect.y) ? kInside : std::uint8_t(0);
        }
    }
    EXPECT_GE(testing::overlap(o.specimen, truth), 0.9);
    EXPECT_EQ(std::count(o.clipped.pixels().begin(), o.clipped.pixels().end(), kInside), 0);
    EXPECT_EQ(o.source_sha256.size(), 64u);
    // The samples are the frames, untouched.
    const Image<SrgbU8> frame = scene.frame(41, 60);
    const Image<SrgbF> sample = o.store->image(41);
    for (int x = 0; x < o.width(); ++x) {
        const SrgbF expected = srgb_from_u8(frame(x + o.crop.rect.x, o.crop.rect.y + 3));
        EXPECT_NEAR(sample(x, 3).g, expected.g, 1e-5);
    }
}

TEST(Observe, BinsAreTrimmedMeansOfTheirFrames) {
    // 2460 frames: 984 bins of 2.5 frames; 99 kept.
    const auto level = [](int i) {
        return SrgbU8{std::uint8_t(i % 200), 100, std::uint8_t(i / 100)};
    };
    const Recording recording = recording_from_function(24, 16, even_times(2460, 0.25), [&](int i) {
        Image<SrgbU8> image(24, 16);
        for (auto& c : image.pixels()) c = level(i);
        return image;
    });
    ObserveOptions options;
    options.crop.mode = CropMode::none;
    const Observation o = observe(recording, options);
    ASSERT_EQ(o.samples.size(), 99u);
    EXPECT_EQ(o.axis.samples, 984);
    EXPECT_NEAR(o.axis.seconds_per_unit, 2460 * 0.25 / 98.4, 1e-9);
    for (const std::size_t s : {std::size_t(0), std::size_t(50), std::size_t(98)}) {
        double sum = 0;
        int count = 0;
        const double width = 2460.0 / 984, bin = 3 + 10.0 * double(s);
        for (int i = 0; i < 2460; ++i) {
            if (std::floor((i + 0.5) / width) == bin) sum += level(i).r, ++count;
        }
        EXPECT_EQ(o.samples[s].frames, count);
        EXPECT_NEAR(o.store->image(int(s))(5, 5).r, sum / count / 255, 2e-5);
        EXPECT_NEAR(o.samples[s].unit, (bin + 0.5) / 10, 1e-9);
    }
    options.keep = Keep::every_sample;
    EXPECT_EQ(observe(recording, options).store->count(), 984);
}

TEST(Observe, FivePercentOfTheFramesMayBeMissing) {
    const MadeScene scene = small_scene();
    std::vector<double> times;
    std::vector<int> which;
    for (int i = 0; i < 80; ++i) {
        if (i % 20 == 13) continue;
        times.push_back(i);
        which.push_back(i);
    }
    const Recording recording =
        recording_from_function(scene.width, scene.height, times,
                                [&](int i) { return scene.frame(which[std::size_t(i)], 80); });
    const Observation o = observe(recording);
    EXPECT_TRUE(has(o.notes, "interpolated_samples"));
    EXPECT_TRUE(has(o.notes, "irregular_times"));
    int filled = 0;
    for (std::size_t i = 0; i < o.samples.size(); ++i) {
        if (!o.samples[i].interpolated) continue;
        ++filled;
        ASSERT_GT(i, 0u);
        const SrgbF a = o.store->image(int(i) - 1)(4, 4), b = o.store->image(int(i))(4, 4),
                    c = o.store->image(int(i) + 1)(4, 4);
        EXPECT_NEAR(b.g, 0.5 * (a.g + c.g), 2e-5);
    }
    EXPECT_GT(filled, 0);
    EXPECT_GT(o.specimen(o.width() / 2, o.height() / 2), 0);
}

TEST(Observe, SameBytesAtAnyThreadCount) {
    const Recording recording = recording_of(small_scene(), 30);
    for (const int size : {0, 40}) {
        ObserveOptions options;
        options.size = size;
        set_thread_count(1);
        const Observation one = observe(recording, options);
        set_thread_count(2);
        const Observation two = observe(recording, options);
        set_thread_count(0);
        EXPECT_EQ(one.crop.rect, two.crop.rect);
        EXPECT_EQ(one.noise.sigma, two.noise.sigma);
        ASSERT_EQ(one.store->count(), two.store->count());
        for (int i = 0; i < one.store->count(); ++i) {
            const Image<SrgbF> a = one.store->image(i), b = two.store->image(i);
            ASSERT_EQ(std::memcmp(a.row(0), b.row(0), a.byte_count()), 0);
        }
        EXPECT_EQ(std::memcmp(one.specimen.row(0), two.specimen.row(0), one.specimen.byte_count()),
                  0);
        EXPECT_EQ(std::memcmp(one.clipped.row(0), two.clipped.row(0), one.clipped.byte_count()), 0);
    }
}

TEST(Observe, SizeAreaAveragesAndTheNoiseFollows) {
    MadeScene scene = small_scene();
    scene.noise = 4.0 / 255;
    ObserveOptions options;
    options.crop = {CropMode::manual, {40, 30, 80, 60}};
    options.size = 20;
    const Observation o = observe(recording_of(scene, 30), options);
    EXPECT_EQ(o.width(), 20);
    EXPECT_EQ(o.height(), 15);
    EXPECT_TRUE(o.specimen.same_size(20, 15));
    // 16 pixels averaged: a quarter of the noise.
    EXPECT_NEAR(o.noise.sigma, 1.0 / 255, 2e-4);
}

TEST(Observe, AGlintIsMarkedAndThePlateIsNot) {
    MadeScene scene = small_scene();
    ObserveOptions options;
    options.crop.mode = CropMode::none;
    const Recording recording = recording_from_function(160, 120, even_times(40), [&](int i) {
        Image<SrgbU8> frame = scene.frame(i, 40);
        for (int y = 50; y < 70; ++y) {
            for (int x = 70; x < 74; ++x) frame(x, y) = {255, 255, 252};
        }
        if (i == 2) frame(100, 62) = {255, 255, 255};  // once, long ago
        return frame;
    });
    const Observation o = observe(recording, options);
    for (int y = 50; y < 70; ++y) EXPECT_EQ(o.clipped(72, y), kInside);
    EXPECT_EQ(o.clipped(69, 60), kInside);  // dilated by one
    EXPECT_EQ(o.clipped(68, 60), 0);
    EXPECT_EQ(o.clipped(100, 62), 0);
    EXPECT_EQ(std::count(o.clipped.pixels().begin(), o.clipped.pixels().end(), kInside), 6 * 22);
    EXPECT_EQ(o.specimen(5, 5), 0);
    EXPECT_EQ(o.specimen(80, 62), kInside);
}

TEST(Observe, ExposureStepsAreNamed) {
    const MadeScene scene = small_scene();
    const Recording recording = recording_from_function(160, 120, even_times(40), [&](int i) {
        Image<SrgbU8> frame = scene.frame(i, 40);
        if (i >= 23) {
            for (auto& c : frame.pixels()) {
                c = {std::uint8_t(c.r * 1.1), std::uint8_t(c.g * 1.1), std::uint8_t(c.b * 1.1)};
            }
        }
        return frame;
    });
    const Observation o = observe(recording);
    ASSERT_TRUE(has(o.notes, "exposure_jump"));
    ASSERT_TRUE(has(o.notes, "exposure_drift"));
    for (const Status& s : o.notes) {
        if (s.id != "exposure_jump") continue;
        EXPECT_NE(s.sentence.find("frame 23"), std::string::npos);
    }
    EXPECT_FALSE(has(observe(recording_of(scene, 40)).notes, "exposure_jump"));
}

TEST(Observe, StillBlackAndWhiteRecordingsAreNotedNotRefused) {
    for (const int level : {0, 120, 255}) {
        const Recording recording = recording_from_function(48, 32, even_times(12), [&](int) {
            Image<SrgbU8> image(48, 32);
            for (auto& c : image.pixels()) {
                c = {std::uint8_t(level), std::uint8_t(level), std::uint8_t(level)};
            }
            return image;
        });
        for (const CropMode mode : {CropMode::automatic, CropMode::none}) {
            ObserveOptions options;
            options.crop.mode = mode;
            const Observation o = observe(recording, options);
            EXPECT_TRUE(has(o.notes, "still_scene"));
            EXPECT_EQ(o.width(), 48);
            EXPECT_EQ(o.noise.tau, 5e-4);
            EXPECT_EQ(o.clipped(3, 3) == kInside, level != 120);
        }
    }
}

TEST(Observe, TwoFramesAreEnoughToStart) {
    const Observation o = observe(recording_of(small_scene(), 2), with_crop({CropMode::none, {}}));
    EXPECT_EQ(o.samples.size(), 2u);
    EXPECT_TRUE(has(o.notes, "few_frames"));
    EXPECT_TRUE(has(o.notes, "noise_from_space"));
    EXPECT_GT(o.noise.sigma, 0);
}

ErrorCode code_of(const Recording& recording, const ObserveOptions& options) {
    try {
        observe(recording, options);
    } catch (const Error& e) {
        return e.code();
    }
    return ErrorCode{};
}

TEST(Observe, RefusesWhatMakesNoSense) {
    const Recording recording = recording_of(small_scene(), 12);
    EXPECT_EQ(code_of(recording_of(small_scene(), 1), {}), ErrorCode::bad_input);
    for (const Rect rect : {Rect{0, 0, 161, 10}, Rect{-1, 0, 10, 10}, Rect{0, 0, 0, 10},
                            Rect{150, 0, 20, 20}, Rect{2147483647, 0, 10, 10}}) {
        EXPECT_EQ(code_of(recording, with_crop({CropMode::manual, rect})), ErrorCode::bad_input);
    }
    ObserveOptions options;
    options.trim = 0.5;
    EXPECT_EQ(code_of(recording, options), ErrorCode::usage);
    options = {};
    options.size = -1;
    EXPECT_EQ(code_of(recording, options), ErrorCode::usage);
    options = {};
    options.units = 1000;
    EXPECT_EQ(code_of(recording, options), ErrorCode::usage);
}

TEST(Observe, StopsWhenAsked) {
    const Recording recording = recording_of(small_scene(), 30);
    for (const std::string stage : {"look", "observe"}) {
        int calls = 0;
        try {
            observe(recording, {}, [&](std::string_view s, std::int64_t done, std::int64_t) {
                if (s == stage) ++calls;
                return !(s == stage && done >= 10);
            });
            FAIL() << "did not stop in stage " << stage;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::interrupted);
            EXPECT_LE(calls, 11);
        }
    }
}

}  // namespace
}  // namespace verdigris
