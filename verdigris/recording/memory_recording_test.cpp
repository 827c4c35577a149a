// SPDX-License-Identifier: MIT
#include "verdigris/recording/memory_recording.h"

#include <gtest/gtest.h>

#include "verdigris/color/convert.h"
#include "verdigris/recording/testing/scratch.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

using namespace testing;

Image<SrgbU8> numbered(int index) {
    Image<SrgbU8> image(5, 3);
    for (SrgbU8& p : image.pixels()) p = {std::uint8_t(index), 7, 9};
    image(4, 2) = {1, 2, 3};
    return image;
}

TEST(MemoryRecording, HandsOnWhatTheFunctionGives) {
    const Recording recording = recording_from_function(5, 3, {2, 3, 5}, numbered, "made");
    const RecordingInfo& info = recording.info();
    EXPECT_EQ(info.times, (std::vector<double>{0, 1, 3}));
    EXPECT_TRUE(info.variable_rate);
    EXPECT_EQ(info.path, "made");
    const auto reader = recording.read();
    Frame frame;
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(reader->next(frame));
        EXPECT_EQ(frame.index, i);
        EXPECT_EQ(frame.seconds, info.times[std::size_t(i)]);
        const auto image = srgb_from_planes(frame.planes, info.format, {0, 0, 5, 3});
        EXPECT_EQ(u8_from_srgb(image(0, 0)), (SrgbU8{std::uint8_t(i), 7, 9}));
        EXPECT_EQ(u8_from_srgb(image(4, 2)), (SrgbU8{1, 2, 3}));
    }
    EXPECT_FALSE(reader->next(frame));
    EXPECT_EQ(reader->report().decoded, 3);
    reader->seek(1);
    ASSERT_TRUE(reader->next(frame));
    EXPECT_EQ(frame.index, 1);
}

TEST(MemoryRecording, HashFollowsTheFrames) {
    const std::string hash = recording_from_function(5, 3, {0, 1}, numbered).sha256();
    EXPECT_EQ(hash.size(), 64u);
    EXPECT_EQ(hash, recording_from_function(5, 3, {0, 1}, numbered).sha256());
    EXPECT_NE(hash, recording_from_function(5, 3, {0, 2}, numbered).sha256());
    EXPECT_NE(hash, recording_from_function(5, 3, {0, 1}, [](int i) {
                        return numbered(i + 1);
                    }).sha256());
}

TEST(MemoryRecording, WrongCallsAreRefused) {
    EXPECT_EQ(error_of([] { recording_from_function(5, 3, {}, numbered); }).code(),
              ErrorCode::usage);
    EXPECT_EQ(error_of([] {
                  recording_from_function(5, 3, {0, 2, 1}, numbered);
              }).code(),
              ErrorCode::usage);
    const Recording wrong = recording_from_function(4, 3, {0, 1}, numbered, "made");
    const auto reader = wrong.read();
    Frame frame;
    const Error error = error_of([&] { reader->next(frame); });
    EXPECT_EQ(error.where(), "made, frame 0");
    EXPECT_EQ(error.sentence(), "is 5 x 3 pixels, but the recording is 4 x 3");
}

}  // namespace
}  // namespace verdigris
