// SPDX-License-Identifier: MIT
// Every value against the paper's own source, which is read anew: what is typed wrong is found.
#include "verdigris/reproduce/paper_values.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "verdigris/files/atomic_file.h"

namespace verdigris {
namespace {
namespace fs = std::filesystem;

const fs::path kPaper = fs::path(VERDIGRIS_SHARED_DATA).parent_path() / "paper" / "paper.tex";

/// "+13.4" and "-43.2" of "$+13.4$", "3.42e-5" of "3.42\,e-5".
std::string number_of(std::string text) {
    text = std::regex_replace(text, std::regex("\\\\,|[$ {}\\\\]|^ *"), "");
    return text;
}

struct Cells {
    int direction;
    std::string row;
    std::vector<std::string> cells;
};

/// The rows of the table with this label that hold numbers.
std::vector<Cells> rows_of(const std::string& paper, const std::string& label) {
    const std::size_t at = paper.find("\\label{" + label + "}");
    const std::string body = paper.substr(at, paper.find("\\end{tabular}", at) - at);
    std::vector<Cells> rows;
    int direction = kNoDirection;
    std::size_t begin = 0;
    while (begin < body.size()) {
        const std::size_t end = std::min(body.find("\\\\", begin), body.size());
        const std::string line = body.substr(begin, end - begin);
        begin = end + 2;
        if (line.find("multicolumn{6}") != std::string::npos)
            direction = line.find("chamber $\\rightarrow$ air") != std::string::npos
                            ? kChamberToAir
                            : kAirToChamber;
        if (line.find('&') == std::string::npos || line.find("multicolumn") != std::string::npos)
            continue;
        Cells row{direction, {}, {}};
        std::size_t from = 0;
        while (from <= line.size()) {
            const std::size_t to = std::min(line.find('&', from), line.size());
            const std::string cell = line.substr(from, to - from);
            if (from == 0)
                row.row = cell;
            else
                row.cells.push_back(number_of(cell));
            from = to + 1;
        }
        rows.push_back(row);
    }
    return rows;
}

/// How the tables call our rows.
const std::map<std::string, std::string> kRowNames{{"persistence", "Persistence"},
                                                   {"affinergb", "model{affinergb}"},
                                                   {"patinanet", "model{patinanet}"},
                                                   {"predformer", "model{predformer}"},
                                                   {"convlstm", "model{convlstm}"},
                                                   {"horizonnet", "model{horizonnet}"},
                                                   {"control", "Static control"},
                                                   {"n3", "$n=3$"},
                                                   {"n5", "$n=5$"},
                                                   {"n7", "$n=7$"},
                                                   {"n10", "$n=10$"},
                                                   {"persistence5", "reference ($n{=}5$"},
                                                   {"persistence10", "reference ($n{=}10$"},
                                                   {"full", "full $3"},
                                                   {"per-channel", "per-channel gain"},
                                                   {"single-gain", "single gain"},
                                                   {"order0", "(0th order)"},
                                                   {"order1", "(1st)"},
                                                   {"order2", "(2nd)"}};
const std::map<std::string, std::size_t> kColumns{
    {"t1", 0},      {"t5", 1},     {"tK", 2},     {"mean", 3},    {"gain", 4},
    {"flip5", 0},   {"lpips5", 1}, {"flip10", 2}, {"lpips10", 3}, {"flip20", 4},
    {"lpips20", 5}, {"flip50", 6}, {"lpips50", 7}};

TEST(PaperValues, AreWhatThePaperPrints) {
    if (!fs::exists(kPaper)) GTEST_SKIP() << "no " << kPaper;
    const std::string paper = read_text(kPaper);
    std::map<std::string, std::size_t> of_table;
    for (const PaperValue& v : paper_values()) {
        SCOPED_TRACE(std::string(v.item) + " " + v.row + " " + v.column + " " + v.printed);
        const std::string source = v.source, printed = v.printed;
        if (source.starts_with("tab:")) {
            int found = 0;
            for (const Cells& row : rows_of(paper, source)) {
                if (row.row.find(kRowNames.at(v.row)) == std::string::npos) continue;
                if (source == "tab:generalise" && row.direction != v.direction) continue;
                const std::size_t column =
                    source == "tab:ablation" ? std::size_t(v.direction) : kColumns.at(v.column);
                ASSERT_LT(column, row.cells.size());
                std::string cell = row.cells[column];
                if (cell.starts_with("+")) cell.erase(0, 1);
                EXPECT_EQ(cell, printed);
                ++found;
            }
            EXPECT_EQ(found, 1);
            ++of_table[source];
        } else if (source.starts_with("\\")) {
            std::smatch macro;
            const std::regex definition("newcommand\\{\\" + source + "\\}\\{([^}]*)\\}");
            ASSERT_TRUE(std::regex_search(paper, macro, definition));
            EXPECT_EQ(std::stod(number_of(macro[1])), std::stod(printed)) << macro[1];
        } else {
            EXPECT_NE(paper.find(source), std::string::npos) << source;
            EXPECT_NE(source.find(printed), std::string::npos) << source;
        }
    }
    // And none is left out: as many as the tables have cells with numbers.
    for (const auto& [label, values] : of_table) {
        std::size_t cells = 0;
        for (const Cells& row : rows_of(paper, label))
            for (const std::string& cell : row.cells)
                cells += !cell.empty() &&
                         std::string("+-0123456789").find(cell[0]) != std::string::npos &&
                         std::regex_match(cell, std::regex("[-+0-9.e]+"));
        EXPECT_EQ(values, cells) << label;
    }
}

TEST(PaperValues, EachIsThereOnce) {
    std::set<std::tuple<std::string, int, std::string, std::string>> seen;
    for (const PaperValue& v : paper_values())
        EXPECT_TRUE(seen.insert({v.item, v.direction, v.row, v.column}).second)
            << v.item << " " << v.row << " " << v.column;
    EXPECT_EQ(paper_value("table1", kChamberToAir, "affinergb", "gain"), 13.4);
    EXPECT_EQ(paper_share("table1", kAirToChamber, "affinergb", "gain"), 0.506);
    EXPECT_FALSE(paper_value("table1", kChamberToAir, "auto", "gain"));
}

}  // namespace
}  // namespace verdigris
