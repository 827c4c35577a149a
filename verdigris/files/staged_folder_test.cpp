// SPDX-License-Identifier: MIT
#include "verdigris/files/staged_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

TEST(StagedFolder, ReplacesNamesakesAndLeavesTheRest) {
    const ScratchFolder folder;
    const fs::path target = folder / "out";
    write_file(target / "manifest.json", "old");
    write_file(target / "maps/old.png", "old");
    write_file(target / "notes.txt", "mine");
    write_file(target / "becomes_folder", "old");
    {
        StagedFolder staged(target);
        EXPECT_EQ(staged.path().parent_path(), target);
        write_file(staged.path() / "manifest.json", "new");
        write_file(staged.path() / "maps/new.png", "new");
        write_file(staged.path() / "becomes_folder/a", "new");
        EXPECT_EQ(read_text(target / "manifest.json"), "old");
        staged.commit("manifest.json");
        EXPECT_THROW(staged.commit(), std::logic_error);
    }
    EXPECT_EQ(read_text(target / "manifest.json"), "new");
    EXPECT_EQ(read_text(target / "maps/new.png"), "new");
    EXPECT_FALSE(fs::exists(target / "maps/old.png"));
    EXPECT_EQ(read_text(target / "becomes_folder/a"), "new");
    EXPECT_EQ(read_text(target / "notes.txt"), "mine");
    EXPECT_EQ(entry_count(target), 4);
}

TEST(StagedFolder, WithoutCommitTheTargetIsAsItWas) {
    const ScratchFolder folder;
    {
        StagedFolder staged(folder / "a/new");
        write_file(staged.path() / "x", "x");
        EXPECT_TRUE(fs::exists(folder / "a/new"));
    }
    EXPECT_FALSE(fs::exists(folder / "a/new"));
    fs::create_directory(folder / "empty");
    write_file(folder / "full/x", "old");
    {
        StagedFolder one(folder / "empty"), two(folder / "full");
        write_file(two.path() / "x", "new");
    }
    EXPECT_TRUE(fs::exists(folder / "empty"));
    EXPECT_EQ(entry_count(folder / "full"), 1);
    EXPECT_EQ(read_text(folder / "full/x"), "old");
}

TEST(StagedFolder, ACreatedTargetThatGotOtherFilesStays) {
    const ScratchFolder folder;
    {
        StagedFolder staged(folder / "new");
        write_file(folder / "new/other", "x");
    }
    EXPECT_EQ(entry_count(folder / "new"), 1);
}

TEST(StagedFolder, RemovesWhatDeadProcessesLeft) {
    const ScratchFolder folder;
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ASSERT_GT(child, 0);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);  // now no process has this pid
    const auto partial = [](pid_t pid, const char* n) {
        return ".partial-" + std::to_string(pid) + "-" + n;
    };
    write_file(folder / partial(child, "1") / "x", "stale");
    write_file(folder / partial(::getpid(), "999999") / "x", "of an earlier process with our pid");
    write_file(folder / partial(1, "1") / "x", "of a living process");
    write_file(folder / ".partial-mine" / "x", "not ours");
    StagedFolder first(folder.path());
    const StagedFolder second(folder.path());
    EXPECT_FALSE(fs::exists(folder / partial(child, "1")));
    EXPECT_FALSE(fs::exists(folder / partial(::getpid(), "999999")));
    EXPECT_TRUE(fs::exists(folder / partial(1, "1")));
    EXPECT_TRUE(fs::exists(folder / ".partial-mine"));
    EXPECT_TRUE(fs::exists(first.path()));
    EXPECT_NE(first.path(), second.path());
}

TEST(StagedFolder, SaysWhyAFolderIsImpossible) {
    const ScratchFolder folder;
    write_file(folder / "file", "x");
    const Error error = error_of([&] { StagedFolder staged(folder / "file"); });
    EXPECT_EQ(error.code(), ErrorCode::failed);
    EXPECT_EQ(error.sentence(), "is a file, not a folder");
    EXPECT_EQ(error.where(), (folder / "file").string());
    EXPECT_EQ(error_of([&] { StagedFolder staged(folder / "file/below"); }).sentence(),
              "cannot be written: a part of the path is a file, not a folder");
    EXPECT_EQ(error_of([] { StagedFolder staged(""); }).code(), ErrorCode::failed);
    {
        StagedFolder staged(folder / "ok");
        EXPECT_THROW(staged.commit("never_written"), std::logic_error);
        staged.commit();
    }
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms(0555));
    fs::permissions(folder.path(), fs::perms(0755));
    const AsNobody nobody;
    EXPECT_EQ(error_of([&] { StagedFolder staged(folder / "locked"); }).sentence(),
              "cannot be written: no permission");
    EXPECT_EQ(error_of([&] { StagedFolder staged(folder / "locked/new"); }).sentence(),
              "cannot be written: no permission");
}

TEST(StagedFolder, AFailedCommitTakesItsMovesBack) {
    const ScratchFolder folder;
    write_file(folder / "a", "old a");
    write_file(folder / "manifest", "old manifest");
    StagedFolder staged(folder.path());
    write_file(staged.path() / "a", "new a");
    write_file(staged.path() / "manifest", "new manifest");
    fs::create_directory(staged.path() / "b");
    // A folder whose own entries nobody may change cannot be moved: its ".." would change.
    fs::permissions(folder.path(), fs::perms(0777));
    fs::permissions(staged.path(), fs::perms(0777));
    fs::permissions(staged.path() / "b", fs::perms(0555));
    const bool was_root = ::geteuid() == 0;
    if (!was_root) GTEST_SKIP() << "needs a folder of another user";
    {
        const AsNobody nobody;
        EXPECT_EQ(error_of([&] { staged.commit("manifest"); }).sentence(),
                  "cannot be written: no permission");
    }
    EXPECT_EQ(read_text(folder / "a"), "old a");
    EXPECT_EQ(read_text(folder / "manifest"), "old manifest");
    EXPECT_EQ(read_text(staged.path() / "a"), "new a");
}

}  // namespace
}  // namespace verdigris
