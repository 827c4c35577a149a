// SPDX-License-Identifier: MIT
// What write_recording refuses, and what is left when it does, or when it is given up.
#include "verdigris/recording/writer_checks.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/scratch.h"
#include "verdigris/recording/testing/written.h"
#include "verdigris/recording/video_writer.h"

namespace verdigris {
namespace {

using namespace testing;

Image<SrgbU8> noisy(int width, int height, unsigned seed) {
    Image<SrgbU8> image(width, height);
    std::mt19937 random(seed);
    for (SrgbU8& p : image.pixels()) {
        p = {std::uint8_t(random()), std::uint8_t(random()), std::uint8_t(random())};
    }
    return image;
}

void write(const std::filesystem::path& target, int frames, bool replace = false) {
    const auto writer = write_recording(target, {.width = 16, .height = 8, .replace = replace});
    for (int i = 0; i < frames; ++i) writer->add(noisy(16, 8, unsigned(i)));
    writer->commit();
}

void expect_refused(const std::filesystem::path& target, const WriterOptions& options,
                    ErrorCode code, const std::string& words) {
    const Error error = error_of([&] { write_recording(target, options); });
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_NE(error.sentence().find(words), std::string::npos) << error.what();
    EXPECT_EQ(error.where(), target.string());
}

const std::vector<std::string>& kinds() {
    static const std::vector<std::string> names =
        have_x264() ? std::vector<std::string>{"a.mp4", "a.mkv", "a"}
                    : std::vector<std::string>{"a.mkv", "a"};
    return names;
}

TEST(WriterChecks, OptionsAndNames) {
    const Scratch scratch;
    const auto usage = [&](const char* name, const WriterOptions& options, const char* words) {
        expect_refused(scratch / name, options, ErrorCode::usage, words);
    };
    usage("a.mp4", {.width = 15, .height = 8}, "an .mp4 needs an even width and height");
    usage("a.mp4", {.width = 16, .height = 7},
          "16 x 7; make them one pixel larger, or write a .mkv");
    usage("a.mp4", {.width = 16, .height = 8, .bits = 16}, "holds 8 bits, not 16; write a .mkv");
    usage("a.mp4", {.width = 16, .height = 8, .crf = 52}, "between 0 and 51");
    usage("a.mp4", {.width = 16, .height = 8, .preset = "quick"}, "no preset 'quick'");
    usage("a.mkv", {.width = 3, .height = 8}, "at least 4 x 4 pixels, not 3 x 8; write a folder");
    usage("a.mkv", {.width = 16, .height = 8, .bits = 10}, "8 or 16 bits, not 10");
    usage("a", {.width = 0, .height = 8}, "frames of 0 x 8 pixels");
    usage("a", {.width = 1 << 15, .height = 1 << 14}, "at most 2^28 in all");
    for (const double fps : {0.0, -1.0, 1001.0, 1e-6, std::nan("")}) {
        usage("a", {.width = 16, .height = 8, .fps = fps}, "frame rate must be between");
    }
    usage("a.avi", {.width = 16, .height = 8}, "ending in '.avi' cannot be written; take .mp4");
    expect_refused("", {.width = 16, .height = 8}, ErrorCode::usage, "name of the recording");
    expect_refused(".", {.width = 16, .height = 8}, ErrorCode::refused, "exists already");
    expect_refused(scratch / "b/..", {.width = 16, .height = 8}, ErrorCode::usage, "not the name");
    EXPECT_EQ(entry_count(scratch.path()), 0);
    EXPECT_EQ(target_kind("a.MP4"), TargetKind::mp4);
    EXPECT_EQ(target_kind("a.mp4/"), TargetKind::folder);
    EXPECT_EQ(target_kind("./a"), TargetKind::folder);
}

TEST(WriterChecks, AMissingEncoderSaysWhatToWriteInstead) {
    const Error error = error_of([] { find_encoder("libnone", "a folder", "x/a.mp4"); });
    EXPECT_EQ(error.code(), ErrorCode::failed);
    EXPECT_STREQ(error.what(),
                 "x/a.mp4: cannot be written: this FFmpeg was built without the encoder libnone; "
                 "write a folder instead");
}

TEST(WriterChecks, FramesThatWereNotAnnounced) {
    for (const std::string& name : kinds()) {
        const Scratch scratch;
        const auto target = scratch / name;
        const auto writer = write_recording(target, {.width = 16, .height = 8});
        EXPECT_EQ(error_of([&] { writer->commit(); }).sentence(),
                  "has no frames, so nothing is written");
        writer->add(noisy(16, 8, 0));
        Error error = error_of([&] { writer->add(noisy(8, 16, 0)); });
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_EQ(error.where(), target.string() + ", frame 1");
        EXPECT_EQ(error.sentence(), "is 8 x 16 pixels, but the recording was announced as 16 x 8");
        error = error_of([&] { writer->add(Image<SrgbU16>(16, 8)); });
        EXPECT_EQ(error.sentence(),
                  "has 16 bits per sample, but the recording was announced with 8");
        writer->add(noisy(16, 8, 1));  // the writer goes on
        writer->commit();
        EXPECT_EQ(open_recording(target).info().times.size(), 2u);
        EXPECT_THROW(writer->add(noisy(16, 8, 2)), std::logic_error);
        EXPECT_THROW(writer->commit(), std::logic_error);
    }
}

TEST(WriterChecks, GivenUpMeansNothingIsLeft) {
    for (const std::string& name : kinds()) {
        const Scratch scratch;
        {
            const auto writer = write_recording(scratch / name, {.width = 16, .height = 8});
            for (int i = 0; i < 40; ++i) writer->add(noisy(16, 8, unsigned(i)));
            EXPECT_FALSE(std::filesystem::exists(scratch / name));
        }
        EXPECT_EQ(entry_count(scratch.path()), 0) << name;
        write(scratch / name, 3);
        const std::string before = read_bytes(scratch / name / "000002.png");
        { write_recording(scratch / name, {.width = 4, .height = 4, .replace = true}); }
        EXPECT_EQ(entry_count(scratch.path()), 1) << name;
        EXPECT_EQ(open_recording(scratch / name).info().times.size(), 3u);
    }
}

TEST(WriterChecks, WhatExistsIsReplacedOnlyWhenAsked) {
    for (const std::string& name : kinds()) {
        const Scratch scratch;
        const auto target = scratch / name;
        write(target, 5);
        expect_refused(target, {.width = 16, .height = 8}, ErrorCode::refused,
                       "exists already and is not replaced unless that is asked for");
        write(target, 3, true);  // fewer frames: none of the old ones stays
        EXPECT_EQ(open_recording(target).info().times.size(), 3u);
        EXPECT_EQ(entry_count(scratch.path()), 1);
        if (name == "a") {
            EXPECT_EQ(entry_count(target), 4);
        }

        // What comes to stand there meanwhile is safe too.
        const auto late = scratch / ("late" + name);
        const auto writer = write_recording(late, {.width = 16, .height = 8});
        writer->add(noisy(16, 8, 0));
        write(late, 2);
        EXPECT_EQ(error_of([&] { writer->commit(); }).code(), ErrorCode::refused);
        EXPECT_EQ(open_recording(late).info().times.size(), 2u);
    }
}

TEST(WriterChecks, OnlyARecordingOfOursIsReplacedAsAFolder) {
    const Scratch scratch;
    const auto refused = [&](const std::string& what) {
        SCOPED_TRACE(what);
        expect_refused(scratch / "a", {.width = 16, .height = 8, .replace = true},
                       ErrorCode::refused, "holds other things than numbered pictures");
    };
    const auto again = [&] {
        std::filesystem::remove_all(scratch / "a");
        write(scratch / "a", 3);
        EXPECT_TRUE(is_written_folder(scratch / "a"));
    };
    for (const char* name : {"notes.txt", "IMG_1.png", "000005.png", "3.png", "0000003.png",
                             "000003.jpg", ".hidden", "99999999999.png"}) {
        again();
        write_bytes(scratch / "a" / name, "x");
        refused(name);
    }
    for (const char* name : {"times.csv", "000001.png"}) {
        again();
        std::filesystem::remove(scratch / "a" / name);
        refused(std::string("without ") + name);
    }
    again();
    std::filesystem::create_directory(scratch / "a/000003.png");
    refused("a folder inside");
    again();
    std::filesystem::create_symlink("000000.png", scratch / "a/000003.png");
    refused("a link inside");

    write_bytes(scratch / "file", "x");
    expect_refused(scratch / "file", {.width = 16, .height = 8, .replace = true},
                   ErrorCode::refused, "is a file, where a folder should be written");
    std::filesystem::create_directory(scratch / "f.mkv");
    expect_refused(scratch / "f.mkv", {.width = 16, .height = 8, .replace = true},
                   ErrorCode::refused, "is a folder, where a video should be written");
    std::filesystem::create_directory(scratch / "empty");
    write(scratch / "empty", 1);  // nothing is lost
    EXPECT_EQ(entry_count(scratch / "empty"), 2);
}

TEST(WriterChecks, LinksStayLinks) {
    const Scratch scratch;
    for (const std::string& name : kinds()) {
        std::filesystem::create_directory(scratch / "real");
        write(scratch / ("real/" + name), 4);
        std::filesystem::create_symlink("real/" + name, scratch / name);
        write(scratch / name, 2, true);
        EXPECT_TRUE(std::filesystem::is_symlink(scratch / name));
        EXPECT_EQ(open_recording(scratch / ("real/" + name)).info().times.size(), 2u);
    }
}

TEST(WriterChecks, AFullDiskNamesTheTargetAndLeavesNothing) {
    for (const std::string& name : kinds()) {
        const Scratch scratch;
        // A limit on the file size fails in the same call as a full disk does.
        const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
        rlimit old_limit{};
        ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
        rlimit small = old_limit;
        small.rlim_cur = 100'000;
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
        const Error error = error_of([&] {
            const auto writer = write_recording(scratch / name, {.width = 256, .height = 256});
            for (int i = 0; i < 60; ++i) writer->add(noisy(256, 256, unsigned(i)));
            writer->commit();
        });
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
        std::signal(SIGXFSZ, old_handler);
        EXPECT_EQ(error.code(), ErrorCode::failed);
        EXPECT_EQ(error.sentence(), "cannot be written: the file is larger than the system allows");
        EXPECT_EQ(error.where(), (scratch / name).string());
        EXPECT_EQ(entry_count(scratch.path()), 0);
    }
}

TEST(WriterChecks, AfterAFailureNothingIsCommitted) {
    for (const std::string& name : kinds()) {
        const Scratch scratch;
        const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
        rlimit old_limit{};
        ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
        rlimit small = old_limit;
        small.rlim_cur = 100'000;
        const auto writer = write_recording(scratch / name, {.width = 256, .height = 256});
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
        EXPECT_THROW(for (int i = 0; i < 60; ++i) writer->add(noisy(256, 256, unsigned(i))), Error);
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
        std::signal(SIGXFSZ, old_handler);
        EXPECT_THROW(writer->add(noisy(256, 256, 0)), Error) << name;
        EXPECT_THROW(writer->commit(), Error) << name;
        EXPECT_FALSE(std::filesystem::exists(scratch / name)) << name;
    }
}

TEST(WriterChecks, NoPermissionIsASentence) {
    const Scratch scratch;
    std::filesystem::create_directory(scratch / "locked");
    std::filesystem::permissions(scratch / "locked", std::filesystem::perms::owner_read |
                                                         std::filesystem::perms::owner_exec |
                                                         std::filesystem::perms::others_exec);
    std::filesystem::permissions(scratch.path(), std::filesystem::perms::others_exec,
                                 std::filesystem::perm_options::add);
    const AsNobody nobody;
    for (const std::string& name : kinds()) {
        expect_refused(scratch / ("locked/" + name), {.width = 16, .height = 8}, ErrorCode::failed,
                       "cannot be written: no permission");
    }
}

}  // namespace
}  // namespace verdigris
