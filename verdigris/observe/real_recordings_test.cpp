// SPDX-License-Identifier: MIT
// Photographs of a real plate. One specimen: these tests hold the program to what is known about
// the frames, not to anything about copper.
#include <gtest/gtest.h>

#include <filesystem>

#include "verdigris/observe/inspect.h"
#include "verdigris/observe/observe.h"
#include "verdigris/recording/recording.h"

namespace verdigris {
namespace {

std::filesystem::path shared(const char* name) {
    return std::filesystem::path(VERDIGRIS_SHARED_DATA) / name;
}
#define SKIP_WITHOUT(path) \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent"

double share(const Mask& mask) {
    const auto inside = std::count(mask.pixels().begin(), mask.pixels().end(), kInside);
    return double(inside) / double(mask.pixel_count());
}
bool has(const Statuses& notes, const std::string& id) {
    return std::any_of(notes.begin(), notes.end(), [&](const Status& s) { return s.id == id; });
}

TEST(RealCopper, FillsTheFrame) {
    const auto folder = shared("real/copper_patinating");
    SKIP_WITHOUT(folder);
    const Observation o = observe(open_recording(folder));
    EXPECT_TRUE(o.crop.fills_frame) << o.crop.sentence;
    EXPECT_EQ(o.crop.rect, (Rect{0, 0, 256, 256}));
    EXPECT_EQ(o.axis.samples, 100);
    EXPECT_EQ(o.store->count(), 100);
    EXPECT_EQ(share(o.specimen), 1);
    // Known: sigma about 3.4 of 255 in the late frames.
    EXPECT_NEAR(o.noise.sigma, 0.0133, 0.002);
    // The flash streak at x = 85..150 is saturated while the plate is wet; the plate is not.
    EXPECT_GT(share(o.clipped), 0.005);
    EXPECT_LT(share(o.clipped), 0.05);
    int streak = 0, elsewhere = 0;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            if (o.clipped(x, y) == kInside) ++(x >= 85 && x <= 150 ? streak : elsewhere);
        }
    }
    EXPECT_GT(streak, 10 * elsewhere);
}

TEST(RealClay, FillsTheFrame) {
    const auto folder = shared("real/clay_solidifying");
    SKIP_WITHOUT(folder);
    const Observation o = observe(open_recording(folder));
    EXPECT_TRUE(o.crop.fills_frame) << o.crop.sentence;
    EXPECT_EQ(o.axis.samples, 100);
}

TEST(RealVideo, IsObservedLikeThePhotographs) {
    const auto file = shared("video/copper_h264.mp4");
    SKIP_WITHOUT(file);
    const Observation o = observe(open_recording(file));
    EXPECT_TRUE(o.crop.fills_frame) << o.crop.sentence;
    EXPECT_EQ(o.axis.samples, 100);
    EXPECT_EQ(o.decode.lost, 0);
    EXPECT_FALSE(has(o.notes, "broken_tail"));
}

TEST(RealVideo, ABrokenTailEndsTheAxis) {
    const auto file = shared("video/copper_h264_truncated.mp4");
    SKIP_WITHOUT(file);
    const Observation o = observe(open_recording(file));
    EXPECT_GE(o.axis.samples, 38);
    EXPECT_LE(o.axis.samples, 45);
    EXPECT_EQ(int(o.samples.size()), o.axis.samples);
    EXPECT_EQ(o.store->count(), o.axis.samples);
    EXPECT_NEAR(o.axis.units, o.axis.samples, 1e-9);
    EXPECT_TRUE(has(o.notes, "broken_tail"));
    EXPECT_GE(o.decode.lost, 1);
    EXPECT_TRUE(has(inspect(open_recording(file)).findings, "broken_tail"));
}

TEST(RealVideo, EveryFileGetsAVerdict) {
    for (const char* name : {"copper_h264_vfr.mp4", "copper_h264_rot90.mp4", "copper_mjpeg.avi",
                             "sample_android_slow_motion.mp4", "bear-vp9-odd-dimensions.webm",
                             "bt709_full_range.mp4", "sample.avi"}) {
        const auto file = shared("video") / name;
        SKIP_WITHOUT(file);
        const Inspection i = inspect(open_recording(file));
        EXPECT_GE(i.frames, 2) << name;
        EXPECT_FALSE(i.verdict_sentence.empty()) << name;
        EXPECT_GT(i.units, 0) << name;
        RecordProperty(name, i.verdict_sentence);
    }
}

}  // namespace
}  // namespace verdigris
