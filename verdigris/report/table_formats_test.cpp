// SPDX-License-Identifier: MIT
#include "verdigris/report/table_formats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"
#include "verdigris/files/testing.h"
#include "verdigris/report/child_process.h"

namespace verdigris {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// Everything that can go wrong in one table.
Table nasty() {
    Table table;
    table.id = "gains";
    table.title = "Gains";
    table.caption = "Gain over persistence, 95 % interval [lo, hi] & more_or_less #1";
    table.note = "Skipped: 3 windows <of> 810; ΔE₀₀ by {CIE} ~ $5 \\ ^";
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"mse", "MSE ×10⁻³", Align::right, {NumberStyle::significant, 3}},
                     {"gain", "Gain", Align::center, {NumberStyle::percent, 1, true}}};
    table.groups = {
        {"A_to_B 100 %",
         {{"affine_rgb, \"full\"", 1.0 / 3, TableCell(0.0641, {-0.01, 0.1}).best()},
          {"[persistence]", 0.1, TableCell{}}}},
        {"", {{"naïve & co", kNan, -0.25}, {"#4", kInf, TableCell(kNan, {-kInf, kInf})}}}};
    return table;
}

TEST(TableFormats, CsvKnownAnswer) {
    const ScratchFolder folder;
    write_csv(folder / "t.csv", table_csv(nasty()));
    EXPECT_EQ(read_text(folder / "t.csv"),
              "group,forecaster,mse,gain,gain_lo,gain_hi\n"
              "A_to_B 100 %,\"affine_rgb, \"\"full\"\"\",0.3333333333333333,0.0641,-0.01,0.1\n"
              "A_to_B 100 %,[persistence],0.1,,,\n"
              ",naïve & co,nan,-0.25,,\n"
              ",#4,inf,nan,-inf,inf\n");
}

TEST(TableFormats, NumbersReturnBitForBitFromCsvAndJson) {
    const std::vector<double> values{0.1, 1.0 / 3, 1e-300, 5e-324, -123456789.123456789, 2.0 / 7e9};
    Table table;
    table.id = "t";
    table.columns = {{"v", "v"}};
    for (const double v : values) table.add_row({TableCell(v, {v / 3, v * 3})});
    const CsvTable csv = table_csv(table);
    const auto json = nlohmann::json::parse(table_json(table));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto& cell = json["rows"][i]["cells"]["v"];
        const std::array<double, 3> want{values[i], values[i] / 3, values[i] * 3};
        const std::array<double, 3> from_json{cell["value"], cell["lo"], cell["hi"]};
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(std::strtod(csv.rows[i][k].c_str(), nullptr), want[k]);
            EXPECT_EQ(from_json[k], want[k]);
        }
    }
}

TEST(TableFormats, JsonSaysNullForWhatIsNoNumber) {
    const auto json = nlohmann::json::parse(table_json(nasty()));
    const auto& rows = json["rows"];
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0]["group"], "A_to_B 100 %");
    EXPECT_EQ(rows[0]["best"], nlohmann::json::array({"gain"}));
    EXPECT_EQ(rows[0]["cells"]["gain"]["lo"], -0.01);
    EXPECT_TRUE(rows[1]["cells"]["gain"].is_null());
    EXPECT_TRUE(rows[2]["cells"]["mse"].is_null());
    EXPECT_TRUE(rows[3]["cells"]["mse"].is_null());
    EXPECT_TRUE(rows[3]["cells"]["gain"]["hi"].is_null());
    EXPECT_FALSE(rows[2].contains("group"));
    EXPECT_EQ(json["columns"][2]["unit"], "fraction");
    EXPECT_FALSE(json["columns"][1].contains("unit"));
}

TEST(TableFormats, PlainTextIsAligned) {
    EXPECT_EQ(table_plain(nasty()),
              "Forecaster          MSE ×10⁻³            Gain\n"
              "------------------  ---------  -------------------------\n"
              "A_to_B 100 %:\n"
              "affine_rgb, \"full\"      0.333  +6.4 % [-1.0 %, +10.0 %]*\n"
              "[persistence]           0.100            n/a\n"
              "naïve & co                NaN          -25.0 %\n"
              "#4                        inf      NaN [-inf, +inf]\n"
              "Skipped: 3 windows <of> 810; ΔE₀₀ by {CIE} ~ $5 \\ ^\n");
}

TEST(TableFormats, HtmlHoldsValuesToSortByAndNoMarkupOfTheData) {
    const std::string html = table_html(nasty());
    EXPECT_NE(html.find("<table id=\"table-gains\">"), std::string::npos);
    EXPECT_NE(html.find("data-value=\"0.3333333333333333\">0.333</td>"), std::string::npos);
    EXPECT_NE(html.find("<strong>+6.4 % [−1.0 %, +10.0 %]</strong>"), std::string::npos);
    EXPECT_NE(html.find("<td class=\"center\" data-missing>n/a</td>"), std::string::npos);
    EXPECT_NE(html.find("affine_rgb, &quot;full&quot;"), std::string::npos);
    EXPECT_EQ(html.find("<of>"), std::string::npos);
    EXPECT_NE(html.find("<th scope=\"row\""), std::string::npos);
}

// One row per line, its columns counted between unescaped ampersands; braces balanced.
TEST(TableFormats, LatexIsWellFormed) {
    const std::string latex = table_latex(nasty());
    EXPECT_NE(latex.find("\\label{tab:gains}"), std::string::npos);
    EXPECT_NE(latex.find("\\begin{tabular}{lrc}"), std::string::npos);
    EXPECT_NE(latex.find("\\textbf{+6.4 \\% {[}$-$1.0 \\%, +10.0 \\%{]}}"), std::string::npos);
    EXPECT_NE(latex.find("\\emph{A\\_to\\_B 100 \\%}"), std::string::npos);
    for (const char* rule : {"\\toprule", "\\midrule", "\\bottomrule", "\\addlinespace"}) {
        EXPECT_NE(latex.find(rule), std::string::npos) << rule;
    }
    int depth = 0, columns = 1, rows = 0;
    for (std::size_t i = 0; i < latex.size(); ++i) {
        if (latex[i] == '\\') {
            if (latex.compare(i, 3, "\\\\\n") == 0) {
                EXPECT_TRUE(columns == 3 || columns == 1) << columns;  // 1: the group's heading
                columns = 1;
                ++rows;
            }
            ++i;  // the escaped character
            continue;
        }
        depth += latex[i] == '{' ? 1 : latex[i] == '}' ? -1 : 0;
        ASSERT_GE(depth, 0);
        columns += latex[i] == '&';
    }
    EXPECT_EQ(depth, 0);
    EXPECT_EQ(rows, 6);
}

TEST(TableFormats, LatexCompiles) {
    const auto pdflatex = find_program("pdflatex");
    if (pdflatex.empty()) GTEST_SKIP() << "no pdflatex on this machine";
    const ScratchFolder folder;
    write_file(folder / "t.tex",
               "\\documentclass{article}\\usepackage{booktabs}\n"
               "\\begin{document}\n" +
                   table_latex(nasty()) + "\\end{document}\n");
    const ProcessResult run =
        run_process({pdflatex,
                     {"-interaction=nonstopmode", "-halt-on-error", "-output-directory",
                      folder.path().string(), (folder / "t.tex").string()},
                     ""});
    EXPECT_EQ(run.exit_status, 0) << run.output;
}

}  // namespace
}  // namespace verdigris
