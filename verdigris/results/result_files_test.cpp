// SPDX-License-Identifier: MIT
#include "verdigris/results/result_files.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {
namespace fs = std::filesystem;

// FIPS 180-4's own example.
constexpr const char* kSumOfAbc =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

void write_result(const fs::path& folder) {
    write_file(folder / "report.html", "abc");
    write_file(folder / "tables" / "errors.csv", "1,2\n");
    write_file_list(folder);
}

std::vector<std::string> ids(const Statuses& findings) {
    std::vector<std::string> out;
    for (const Status& s : findings) out.push_back(s.id);
    return out;
}
using Ids = std::vector<std::string>;

TEST(ResultFiles, AreListedAsSha256sumReadsThem) {
    const ScratchFolder folder;
    write_result(folder.path());
    const std::string text = read_text(folder / kFileList);
    EXPECT_EQ(text.substr(0, 78), std::string(kSumOfAbc) + "  report.html\n") << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
    const FileList list = read_file_list(folder.path());
    EXPECT_EQ(list.at("report.html"), kSumOfAbc);
    EXPECT_TRUE(list.contains("tables/errors.csv"));
    EXPECT_TRUE(check_file_list(folder.path()).empty());
}

// A line taken out of the list does not make its file somebody's own.
TEST(ResultFiles, WhatEveryResultHasMustBeListed) {
    const ScratchFolder folder;
    write_result(folder.path());
    EXPECT_TRUE(check_file_list(folder.path(), {"report.html", "tables/errors.csv"}).empty());
    const std::string text = read_text(folder / kFileList);
    write_file(folder / kFileList, text.substr(text.find('\n') + 1));
    EXPECT_EQ(ids(check_file_list(folder.path(), {"report.html"})),
              (Ids{"file_list_incomplete", "file_not_listed"}));
}

TEST(ResultFiles, WhatWasChangedRemovedOrAddedIsSeen) {
    const ScratchFolder folder;
    write_result(folder.path());
    write_file(folder / "notes.txt", "mine");
    Statuses found = check_file_list(folder.path());
    ASSERT_EQ(ids(found), Ids{"file_not_listed"});
    EXPECT_EQ(found[0].severity, Severity::info);
    EXPECT_NE(found[0].sentence.find("notes.txt"), std::string::npos) << found[0].sentence;

    write_file(folder / "report.html", "abd");
    EXPECT_EQ(ids(check_file_list(folder.path())), (Ids{"file_changed", "file_not_listed"}));
    fs::remove(folder / "tables" / "errors.csv");
    found = check_file_list(folder.path());
    EXPECT_EQ(ids(found), (Ids{"file_changed", "file_missing", "file_not_listed"}));
    EXPECT_EQ(found[1].severity, Severity::refusal);
    // Among ours nobody's own file is taken for harmless.
    write_file(folder / "tables" / "mine.csv", "3\n");
    EXPECT_EQ(ids(check_file_list(folder.path())),
              (Ids{"file_changed", "file_missing", "file_added", "file_not_listed"}));
    fs::remove(folder / kFileList);
    EXPECT_EQ(ids(check_file_list(folder.path())), Ids{"file_list_missing"});
}

TEST(ResultFiles, AListThatLeadsElsewhereOrIsNoneIsRefused) {
    const ScratchFolder folder;
    for (const std::string& line :
         {std::string(kSumOfAbc) + "  ../outside", std::string(kSumOfAbc) + "  /etc/hostname",
          std::string(kSumOfAbc) + "  a/../../b", std::string(kSumOfAbc) + " one blank",
          std::string("abc  report.html"), std::string(kSumOfAbc) + "  "}) {
        write_file(folder / kFileList, line + "\n");
        const Error e = error_of([&] { read_file_list(folder.path()); });
        EXPECT_EQ(e.code(), ErrorCode::bad_input) << line;
        EXPECT_NE(e.where().find("line 1"), std::string::npos);
    }
}

TEST(ResultFiles, WhoseFileItIsCanBeTold) {
    const ScratchFolder folder;
    write_result(folder.path());
    const FileList list = read_file_list(folder.path());
    EXPECT_EQ(unlisted_file(folder.path(), "tables", list), "");
    EXPECT_EQ(unlisted_file(folder.path(), "report.html", list), "");
    EXPECT_EQ(unlisted_file(folder.path(), "figures", list), "");
    EXPECT_EQ(unlisted_file(folder.path(), "tables", {}), "tables/errors.csv");
    write_file(folder / "tables" / "deep" / "mine.csv", "3\n");
    EXPECT_EQ(unlisted_file(folder.path(), "tables", list), "tables/deep/mine.csv");
    write_file(folder / "figures", "a file");
    EXPECT_EQ(unlisted_file(folder.path(), "figures", list), "figures");
}

TEST(ResultFiles, OfAnOlderResultOnlyItsOwnUnchangedFilesGo) {
    const ScratchFolder folder;
    write_file(folder / "figures" / "old.svg", "old");
    write_file(folder / "figures" / "touched.svg", "drawn");
    write_file(folder / "alone" / "one.svg", "old");
    write_result(folder.path());
    const FileList before = read_file_list(folder.path());
    // The next result has no figures.
    write_file(folder / "figures" / "touched.svg", "by hand");
    write_file(folder / "mine.txt", "mine");
    write_file(folder / kFileList, std::string(kSumOfAbc) + "  report.html\n" +
                                       before.at("tables/errors.csv") + "  tables/errors.csv\n");
    remove_left_over(folder.path(), before);
    EXPECT_FALSE(fs::exists(folder / "figures" / "old.svg"));
    EXPECT_FALSE(fs::exists(folder / "alone"));
    EXPECT_TRUE(fs::exists(folder / "figures" / "touched.svg"));
    EXPECT_TRUE(fs::exists(folder / "mine.txt"));
    EXPECT_TRUE(fs::exists(folder / "report.html"));
    EXPECT_TRUE(fs::exists(folder / "tables" / "errors.csv"));
}

}  // namespace
}  // namespace verdigris
