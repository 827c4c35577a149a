// SPDX-License-Identifier: MIT
#include "verdigris/files/csv.h"

#include <gtest/gtest.h>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

using Row = std::vector<std::string>;

CsvTable parse(const std::string& text) {
    const ScratchFolder folder;
    write_file(folder / "a.csv", text);
    return read_csv(folder / "a.csv");
}

TEST(Csv, ReadsWhatPeopleWrite) {
    const CsvTable table = parse(
        "\xef\xbb\xbf# a comment, with \"quotes\n"
        "File, Time\r\n"
        "\n"
        "a.png,1\r\n"
        "# another\n"
        "\"b, the \"\"second\"\"\n.png\",2\n"
        "c.png,\n"
        ",");
    EXPECT_EQ(table.header, (Row{"File", " Time"}));
    ASSERT_EQ(table.rows.size(), 4u);
    EXPECT_EQ(table.rows[0], (Row{"a.png", "1"}));
    EXPECT_EQ(table.rows[1], (Row{"b, the \"second\"\n.png", "2"}));
    EXPECT_EQ(table.rows[2], (Row{"c.png", ""}));
    EXPECT_EQ(table.rows[3], (Row{"", ""}));
    EXPECT_EQ(table.lines, (std::vector<int>{4, 6, 8, 9}));
    EXPECT_EQ(table.column("file"), 0);
    EXPECT_EQ(table.column("TIME"), 1);
    EXPECT_EQ(table.column("frame"), -1);
}

TEST(Csv, LineEndsOfEverySystem) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const CsvTable table = parse("a,b" + end + "1,2" + end + "3,4");
        EXPECT_EQ(table.header, (Row{"a", "b"}));
        EXPECT_EQ(table.rows, (std::vector<Row>{{"1", "2"}, {"3", "4"}}));
        EXPECT_EQ(table.lines, (std::vector<int>{2, 3}));
    }
}

TEST(Csv, RoundTripsAwkwardCells) {
    const ScratchFolder folder;
    CsvTable table;
    table.header = {"#name", "value"};
    table.rows = {{"a,b", "\"quoted\""},
                  {"line\nbreak", "\r"},
                  {"", ""},
                  {" # ", "gr\xc3\xbcn"},
                  {"#1", "#2"}};
    write_csv(folder / "a.csv", table);
    const CsvTable read = read_csv(folder / "a.csv");
    EXPECT_EQ(read.header, table.header);
    EXPECT_EQ(read.rows, table.rows);
    EXPECT_EQ(read_text(folder / "a.csv").back(), '\n');

    CsvTable narrow;
    narrow.header = {"only"};
    narrow.rows = {{""}, {"x"}, {""}};
    write_csv(folder / "b.csv", narrow);
    EXPECT_EQ(read_csv(folder / "b.csv").rows, narrow.rows);

    table.rows.push_back({"too short"});
    EXPECT_EQ(error_of([&] { write_csv(folder / "c.csv", table); }).code(), ErrorCode::failed);
}

TEST(Csv, NamesTheLineOfAMistake) {
    const ScratchFolder folder;
    const auto what = [&](const std::string& text) {
        write_file(folder / "a.csv", text);
        const Error error = error_of([&] { read_csv(folder / "a.csv"); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        std::string where = error.where();
        where.erase(0, (folder / "a.csv").string().size());
        return where + ": " + error.sentence();
    };
    EXPECT_EQ(what("a,b\n1,2\n3\n"), ", line 3: has 1 cell, the header has 2");
    EXPECT_EQ(what("a,b\n\"1\n2\",3\n4,5,6\n"), ", line 4: has 3 cells, the header has 2");
    EXPECT_EQ(what("a,b\n1,\"2\n"), ", line 2: opens a quote that never ends");
    EXPECT_EQ(what("a,b\n1,\"2\"x\n"), ", line 2: has text after a closing quote");
    EXPECT_EQ(what("a,b\n1,2\"\n"), ", line 2: has a quote inside a plain cell");
    EXPECT_EQ(what("a;b\n1;2\n"), ", line 1: separates by semicolons; save the table with commas");
    EXPECT_EQ(what(std::string("a,b\n1,\0\n", 8)), ", line 2: is not text");
    EXPECT_EQ(what(""), ": holds no table");
    EXPECT_EQ(what("# only a comment"), ": holds no table");
    EXPECT_EQ(error_of([&] { read_csv(folder / "missing.csv"); }).sentence(), "does not exist");
}

TEST(Csv, ReadsTheSharedOpticalConstants) {
    const std::filesystem::path path =
        std::filesystem::path(VERDIGRIS_SHARED_DATA) / "optical/nk_Cu_Johnson.csv";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
    const CsvTable table = read_csv(path);
    EXPECT_GT(table.rows.size(), 20u);
    for (const Row& row : table.rows) EXPECT_GT(seconds_from_text(row[0]), 0);  // plain numbers
}

}  // namespace
}  // namespace verdigris
