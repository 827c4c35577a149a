// SPDX-License-Identifier: MIT
#include "verdigris/report/table.h"

#include <gtest/gtest.h>

#include <limits>

#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

Table small() {
    Table table;
    table.id = "scores";
    table.columns = {{"name", "Name", Align::left}, {"mse", "MSE"}};
    table.add_row({"a", 2.0});
    table.add_row({"b", 1.0});
    return table;
}

std::string complaint(const Table& table) {
    return error_of([&] { check_table(table); }).what();
}

TEST(Table, CellsKnowWhatTheyAre) {
    EXPECT_EQ(TableCell{}.kind(), TableCell::Kind::missing);
    EXPECT_EQ(TableCell(0).kind(), TableCell::Kind::number);
    EXPECT_EQ(TableCell("").kind(), TableCell::Kind::words);
    EXPECT_EQ(TableCell(1.0, {0.5, 2}).bounds()->hi, 2);
    EXPECT_TRUE(TableCell(1).best().is_best());
}

TEST(Table, WhatCannotBeWrittenIsRefusedByName) {
    EXPECT_NO_THROW(check_table(small()));
    Table table = small();
    table.add_row({"c"});
    EXPECT_EQ(complaint(table),
              "table 'scores': is not written: a row has 1 cells, the header has 2");
    table = small();
    table.id = "../scores";
    EXPECT_NE(complaint(table).find("its id must be"), std::string::npos);
    table = small();
    table.columns[1].id = "name";
    EXPECT_NE(complaint(table).find("two of its columns are called 'name'"), std::string::npos);
    table = small();
    table.columns[1].id = "m s e";
    EXPECT_NE(complaint(table).find("the column id 'm s e'"), std::string::npos);
    EXPECT_NE(complaint(Table{"empty", "", "", "", {}, {}}).find("no column"), std::string::npos);
}

TEST(Table, TheColumnsOfAnIntervalAreItsOwn) {
    Table table = small();
    table.columns.push_back({"mse_lo", "other"});
    for (TableRow& row : table.groups[0].rows) row.push_back(0);
    EXPECT_NO_THROW(check_table(table));
    table.columns[1].interval = true;
    EXPECT_NE(complaint(table).find("'mse_lo'"), std::string::npos);
    EXPECT_TRUE(table.has_interval(1));
    EXPECT_FALSE(table.has_interval(2));
}

TEST(Table, TheBestIsMarkedGroupByGroup) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Table table = small();
    table.groups.push_back({"second", {{"c", kNan}, {"d", 3.0}, {"e", TableCell{}}, {"f", 3.0}}});
    mark_best(table, "mse", Better::lower);
    const auto best = [&](std::size_t g, std::size_t r) {
        return table.groups[g].rows[r][1].is_best();
    };
    EXPECT_FALSE(best(0, 0));
    EXPECT_TRUE(best(0, 1));
    EXPECT_FALSE(best(1, 0));
    EXPECT_TRUE(best(1, 1));
    EXPECT_FALSE(best(1, 2));
    EXPECT_TRUE(best(1, 3));
    mark_best(table, "mse", Better::higher);
    EXPECT_TRUE(best(0, 0));
    EXPECT_FALSE(best(0, 1));
    EXPECT_THROW(mark_best(table, "none", Better::lower), Error);
}

}  // namespace
}  // namespace verdigris
