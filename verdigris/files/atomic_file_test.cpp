// SPDX-License-Identifier: MIT
#include "verdigris/files/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <csignal>
#include <stdexcept>
#include <vector>

#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, TargetAppearsOnCommitOnly) {
    const ScratchFolder folder;
    const fs::path target = folder / "a" / "b.txt";
    {
        AtomicFile file(target);
        file.write("hello ");
        file.write(std::string(200000, 'x'));
        EXPECT_FALSE(fs::exists(target));
        EXPECT_EQ(file.temporary().parent_path(), target.parent_path());
        file.commit();
        EXPECT_TRUE(fs::exists(target));
    }
    EXPECT_EQ(read_text(target), "hello " + std::string(200000, 'x'));
    EXPECT_EQ(entry_count(folder / "a"), 1);
}

TEST(AtomicFile, WithoutCommitNothingIsLeftAndTheOldFileStays) {
    const ScratchFolder folder;
    write_file(folder / "a", "old");
    {
        AtomicFile file(folder / "a");
        file.write("new");
    }
    EXPECT_EQ(read_text(folder / "a"), "old");
    EXPECT_EQ(entry_count(folder.path()), 1);
}

TEST(AtomicFile, RewritesInPlaceOnly) {
    const ScratchFolder folder;
    AtomicFile file(folder / "a");
    file.write("0123456789");
    const std::array patch{std::byte{'A'}, std::byte{'B'}};
    file.rewrite(8, patch);
    EXPECT_THROW(file.rewrite(9, patch), std::out_of_range);
    EXPECT_THROW(file.rewrite(std::size_t(-1), patch), std::out_of_range);
    file.write("!");
    file.commit();
    EXPECT_EQ(read_text(folder / "a"), "01234567AB!");
    EXPECT_THROW(file.write("more"), std::logic_error);
    EXPECT_THROW(file.commit(), std::logic_error);
}

TEST(AtomicFile, HasThePermissionsOfAnOrdinaryFile) {
    const ScratchFolder folder;
    const mode_t old = ::umask(027);
    write_file(folder / "a", "text");
    ::umask(old);
    EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0640));
}

TEST(AtomicFile, FollowsLinks) {
    const ScratchFolder folder;
    write_file(folder / "real", "old");
    fs::create_symlink("real", folder / "link");
    write_file(folder / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_text(folder / "real"), "new");
}

TEST(AtomicFile, LongNamesWork) {
    const ScratchFolder folder;
    write_file(folder / std::string(255, 'n'), "text");
    EXPECT_EQ(read_text(folder / std::string(255, 'n')), "text");
    const Error error = error_of([&] { write_file(folder / std::string(256, 'n'), "text"); });
    EXPECT_EQ(error.sentence(), "cannot be written: the name is too long");
    EXPECT_EQ(entry_count(folder.path()), 1);
}

TEST(AtomicFile, SaysWhyATargetIsImpossible) {
    const ScratchFolder folder;
    const auto sentence = [](const fs::path& target) {
        const Error error = error_of([&] { AtomicFile file(target); });
        EXPECT_EQ(error.code(), ErrorCode::failed);
        EXPECT_EQ(error.where(), target.string());
        return error.sentence();
    };
    EXPECT_EQ(sentence(folder.path()), "cannot be written: it is a folder");
    write_file(folder / "file", "");
    EXPECT_EQ(sentence(folder / "file/below"),
              "cannot be written: a part of the path is a file, not a folder");
    EXPECT_EQ(sentence("/dev/full"), "cannot be written: it is not a regular file");
    EXPECT_EQ(sentence(""), "cannot be written: the name is missing");
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms(0555));
    fs::permissions(folder.path(), fs::perms(0755));
    const AsNobody nobody;
    EXPECT_EQ(sentence(folder / "locked/a"), "cannot be written: no permission");
}

TEST(AtomicFile, AFullDiskIsASentenceAndLeavesNothing) {
    const ScratchFolder folder;
    write_file(folder / "a", "old");
    // A limit on the file size fails in the same call as a full disk does.
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    rlimit small = old_limit;
    small.rlim_cur = 1000;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Error error = error_of([&] { write_file(folder / "a", std::string(5000, 'x')); });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_EQ(error.code(), ErrorCode::failed);
    EXPECT_EQ(error.sentence(), "cannot be written: the file is larger than the system allows");
    EXPECT_EQ(read_text(folder / "a"), "old");
    EXPECT_EQ(entry_count(folder.path()), 1);
}

TEST(RemoveAbandoned, TakesTheTemporariesOfThatFileAlone) {
    const ScratchFolder folder;
    fs::path there;
    {
        AtomicFile file(folder / "a");
        there = file.temporary();
    }
    write_file(there, "half");  // as if the process had been killed
    for (const char* other : {"a", "ab", ".a.tmp", ".a.notes.tmp", ".a.1-x.tmp", ".ab.1-1.tmp",
                              ".a.1-1.tmp.txt", "a.1-1.tmp"})
        write_file(folder / other, "kept");
    write_file(folder / ".a.77-3.tmp", "half");
    remove_abandoned(folder / "a");
    EXPECT_FALSE(fs::exists(there));
    EXPECT_FALSE(fs::exists(folder / ".a.77-3.tmp"));
    EXPECT_EQ(entry_count(folder.path()), 8);
    EXPECT_NO_THROW(remove_abandoned(folder / "missing" / "a"));
}

TEST(ReadFile, RoundTripsBytes) {
    const ScratchFolder folder;
    std::vector<std::byte> bytes;
    for (int i = 0; i < 1000; ++i) bytes.push_back(std::byte(i * 7 & 0xff));
    write_file(folder / "a", bytes);
    EXPECT_EQ(read_file(folder / "a"), bytes);
    EXPECT_EQ(read_file(folder / "a", 1000), bytes);
    write_file(folder / "empty", "");
    EXPECT_TRUE(read_file(folder / "empty").empty());
}

TEST(ReadFile, SaysWhyAFileCannotBeRead) {
    const ScratchFolder folder;
    write_file(folder / "a", "12345");
    const auto sentence = [](const fs::path& path, std::size_t limit) {
        const Error error = error_of([&] { read_file(path, limit); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_EQ(error.where(), path.string());
        return error.sentence();
    };
    EXPECT_EQ(sentence(folder / "missing", 10), "does not exist");
    EXPECT_EQ(sentence(folder.path(), 10), "is a folder, not a file");
    EXPECT_EQ(sentence(folder / "a", 4), "is too large: 5 bytes, the limit is 4");
    EXPECT_EQ(sentence("/dev/null", 4), "is not a regular file");
    fs::permissions(folder / "a", fs::perms(0));
    fs::permissions(folder.path(), fs::perms(0755));
    const AsNobody nobody;
    EXPECT_EQ(sentence(folder / "a", 10), "cannot be opened: no permission");
}

}  // namespace
}  // namespace verdigris
