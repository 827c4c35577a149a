// SPDX-License-Identifier: MIT
#include "verdigris/recording/photo_times.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "verdigris/recording/testing/scratch.h"

namespace verdigris {
namespace {

using namespace testing;
using Taken = std::vector<std::optional<double>>;

std::vector<Photo> photos_taken(const Taken& taken) {
    std::vector<Photo> photos;
    for (std::size_t i = 0; i < taken.size(); ++i) {
        Photo photo{std::string(1, char('a' + i)), {}, {}};
        photo.info.taken = taken[i];
        photos.push_back(photo);
    }
    return photos;
}

std::string names(const std::vector<Photo>& photos) {
    std::string text;
    for (const Photo& photo : photos) text += photo.name;
    return text;
}

TEST(PhotoTimes, ExifTimesOrderThePhotographs) {
    auto photos = photos_taken({1000.5, 1010.25, 1005.0, 1020.0, 1030.0});
    RecordingInfo info;
    time_photos(photos, {}, info);
    EXPECT_EQ(info.time_source, TimeSource::exif);
    EXPECT_EQ(names(photos), "acbde");
    EXPECT_EQ(info.times, (std::vector<double>{0, 4.5, 9.75, 19.5, 29.5}));
    EXPECT_TRUE(has_note(info.notes, "times_reordered"));
    EXPECT_FALSE(has_note(info.notes, "times_spread"));
}

TEST(PhotoTimes, PhotographsOfOneSecondAreSpreadOverIt) {
    auto photos = photos_taken({100.0, 100.0, 100.0, 100.0, 101.0, 101.0});
    RecordingInfo info;
    time_photos(photos, {}, info);
    EXPECT_EQ(names(photos), "abcdef");
    EXPECT_EQ(info.times, (std::vector<double>{0, 0.25, 0.5, 0.75, 1, 1.5}));
    EXPECT_TRUE(has_note(info.notes, "times_spread"));
}

TEST(PhotoTimes, FractionsOfASecondAreBelieved) {
    auto photos = photos_taken({100.5, 100.5, 101.0});
    RecordingInfo info;
    time_photos(photos, {}, info);
    EXPECT_EQ(info.times, (std::vector<double>{0, 0, 0.5}));
    EXPECT_FALSE(has_note(info.notes, "times_spread"));
}

TEST(PhotoTimes, ExifThatSaysNothingIsNotUsed) {
    for (const Taken& taken : {Taken{7.0, 7.0, 7.0}, Taken{7.0, std::nullopt, 9.0}}) {
        auto photos = photos_taken(taken);
        RecordingInfo info;
        time_photos(photos, {}, info);
        EXPECT_EQ(info.time_source, TimeSource::file_order);
        EXPECT_EQ(info.times, (std::vector<double>{0, 1, 2}));
        EXPECT_TRUE(has_note(info.notes, "no_times"));
    }
}

TEST(PhotoTimes, PicturesWithoutAKnownTimeAreTakenOut) {
    auto photos = photos_taken({10.0, 20.0, 30.0});
    photos[1].broken = "is damaged";
    photos[1].info = {};
    RecordingInfo info;
    time_photos(photos, {}, info);
    EXPECT_EQ(info.time_source, TimeSource::exif);
    EXPECT_EQ(names(photos), "ac");
    EXPECT_EQ(info.times, (std::vector<double>{0, 20}));
    EXPECT_TRUE(has_note(info.notes, "unreadable_pictures"));
}

TEST(PhotoTimes, ExifThatRunsBackwardsIsRefused) {
    auto photos = photos_taken({40.0, 30.0, 20.0, 50.0});
    RecordingInfo info;
    info.path = "folder";
    const Error error = error_of([&] { time_photos(photos, {}, info); });
    EXPECT_EQ(error.where(), "folder");
    EXPECT_NE(error.sentence().find("from EXIF run backwards"), std::string::npos);
    EXPECT_NE(error.sentence().find("2 of 3 steps"), std::string::npos);
}

}  // namespace
}  // namespace verdigris
