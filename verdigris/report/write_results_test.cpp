// SPDX-License-Identifier: MIT
#include "verdigris/report/write_results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/staged_folder.h"
#include "verdigris/files/testing.h"
#include "verdigris/report/draw_figure.h"
#include "verdigris/report/testing.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

Table scores() {
    Table table;
    table.id = "scores";
    table.columns = {{"name", "Name", Align::left}, {"mse", "MSE"}};
    table.add_row({"a", 0.5});
    return table;
}

Report small_report() {
    return {
        "Title", "", {{"first", "First", {Paragraph{"Words."}, scores(), simple_figure()}}}, ""};
}

std::vector<std::string> names(const WrittenResults& results) {
    std::vector<std::string> out;
    for (const fs::path& file : results.files) out.push_back(file.string());
    return out;
}

bool has(const Statuses& statuses, const std::string& id) {
    return std::any_of(statuses.begin(), statuses.end(),
                       [&](const Status& s) { return s.id == id; });
}

TEST(WriteResults, EveryFormatOfEveryPart) {
    if (!gnuplot_is_installed()) GTEST_SKIP() << "no gnuplot on this machine";
    const ScratchFolder folder;
    Table windows = scores();
    windows.id = "windows";
    StagedFolder staged(folder / "results");
    const WrittenResults results = write_results(small_report(), staged.path(), {windows});
    EXPECT_EQ(names(results), (std::vector<std::string>{"tables/scores.csv", "tables/scores.json",
                                                        "tables/scores.tex", "tables/windows.csv",
                                                        "figures/simple.svg", "figures/simple.png",
                                                        "report.html"}));
    staged.commit();
    for (const fs::path& file : results.files) {
        EXPECT_GT(fs::file_size(folder / "results" / file), 0u) << file;
    }
    EXPECT_FALSE(has(results.statuses, "figures_left_out"));
}

TEST(WriteResults, SameReportSameBytes) {
    const ScratchFolder folder;
    const WrittenResults once = write_results(small_report(), folder / "a");
    write_results(small_report(), folder / "b");
    for (const fs::path& file : once.files) {
        EXPECT_EQ(read_text(folder / "a" / file), read_text(folder / "b" / file)) << file;
    }
}

TEST(WriteResults, WithoutGnuplotTheRestIsWrittenAndSaysSo) {
    const ScratchFolder folder;
    const std::string old = std::getenv("PATH");
    ::setenv("PATH", "/nowhere", 1);
    const WrittenResults results = write_results(small_report(), folder.path());
    ::setenv("PATH", old.c_str(), 1);
    EXPECT_TRUE(has(results.statuses, "figures_left_out"));
    EXPECT_FALSE(fs::exists(folder / "figures"));
    EXPECT_TRUE(fs::exists(folder / "tables/scores.tex"));
    EXPECT_NE(read_text(folder / "report.html").find("gnuplot-nox"), std::string::npos);
}

TEST(WriteResults, PointsThatAreNotDrawnAreCounted) {
    const ScratchFolder folder;
    Report report = small_report();
    Figure& figure = std::get<Figure>(report.sections[0].blocks[2]);
    figure.panels[0].series[0].points[1].y = std::numeric_limits<double>::infinity();
    const WrittenResults results = write_results(report, folder.path());
    ASSERT_TRUE(has(results.statuses, "points_left_out"));
    EXPECT_NE(results.statuses[0].sentence.find("leaves out 1 point that is not finite"),
              std::string::npos);
}

TEST(WriteResults, IsRefusedBeforeAnythingIsWritten) {
    const ScratchFolder folder;
    Report report = small_report();
    report.sections[0].blocks.push_back(scores());
    EXPECT_THROW(write_results(report, folder.path()), Error);
    EXPECT_THROW(write_results(small_report(), folder.path(), {scores()}), Error);
    EXPECT_EQ(entry_count(folder.path()), 0);
}

TEST(WriteResults, CanBeStopped) {
    const ScratchFolder folder;
    const Error error = error_of([&] {
        write_results(small_report(), folder.path(), {},
                      [](std::string_view, std::int64_t done, std::int64_t) { return done < 1; });
    });
    EXPECT_EQ(error.code(), ErrorCode::interrupted);
}

}  // namespace
}  // namespace verdigris
