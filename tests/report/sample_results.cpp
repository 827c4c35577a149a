// SPDX-License-Identifier: MIT
// A results folder from made numbers, as `evaluate` writes one:  verdigris_sample_results FOLDER
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <utility>
#include <variant>

#include "sample_figures.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/staged_folder.h"
#include "verdigris/report/report.h"

namespace {

using namespace verdigris;

Table gains() {
    Table table;
    table.id = "gains";
    table.title = "Gain over persistence";
    table.caption =
        "Mean masked MSE and gain over persistence; 95 % interval of the block bootstrap.";
    table.note = "810 windows, 6 independent blocks. Made numbers: a sample of the layout.";
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"mse", "MSE ×10⁻³", Align::right, {NumberStyle::significant, 3}},
                     {"gain", "Gain", Align::right, {NumberStyle::percent, 1, true}, true},
                     {"de", "ΔE₀₀", Align::right, {NumberStyle::fixed, 2}}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    table.groups = {{"chamber to air",
                     {{"persistence", 4.2, TableCell{}, 3.1},
                      {"affinergb", 3.93, TableCell(0.064, {0.021, 0.103}), 2.87},
                      {"affine, per channel", 12.0, TableCell(-1.857, {-2.5, -1.2}), 5.5}}},
                    {"air to chamber",
                     {{"persistence", 5.1, TableCell{}, 3.6},
                      {"affinergb", 5.35, TableCell(-0.049, {-0.09, 0.004}), 3.72},
                      {"single gain", nan, TableCell(nan, {nan, nan}), nan}}}};
    mark_best(table, "mse", Better::lower);
    mark_best(table, "de", Better::lower);
    return table;
}

/// As wide as `characterize` of two recordings: it has to fit beside the contents at 1280 pixels.
Table settings() {
    Table table;
    table.id = "settings";
    table.title = "What a forecaster needs";
    table.columns = {{"setting", "Setting", Align::left}};
    const NumberFormat error{NumberStyle::scientific, 2}, whole{NumberStyle::percent, 0, true};
    for (const char* direction : {"open air \u2192 chamber", "chamber \u2192 open air"}) {
        const std::string id = table.columns.size() == 1 ? "first" : "second";
        table.columns.push_back({id, direction, Align::right, error});
        table.columns.push_back({id + "_gain", "gain", Align::right, whole, true});
    }
    table.add_row({"hold last transform (0th order)", 4.9e-5, TableCell(0, {0, 0}), 7.7e-5,
                   TableCell(0, {0, 0})});
    table.add_row({"accelerating drift (2nd)", 4.5e-4, TableCell(-8.1, {-13.1, -1.2}), 2.7e-3,
                   TableCell(-34.5, {-46.2, -26.4})});
    return table;
}

Report sample_report() {
    ReportSection verdict{"verdict", "Verdict", {}};
    verdict.blocks = {
        Paragraph{
            "On these made numbers affinergb gains 6.4 % over persistence from chamber to air "
            "and loses 4.9 % from air to chamber."},
        Status{
            "few_blocks", Severity::caution,
            "Six independent blocks carry all of the evidence; the naive interval is too narrow."},
        gains(), settings()};
    ReportSection detail{
        "detail", "In detail", {BulletList{{"One point of two <is> words.", "Two."}}}};
    for (Figure& figure : sample_figures()) detail.blocks.emplace_back(std::move(figure));
    return {"A sample of a report",
            "Made numbers, to look at the layout",
            {verdict, detail},
            "verdigris_sample_results"};
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("verdigris_sample_results FOLDER\n", stderr);
        return 2;
    }
    try {
        StagedFolder staged(arguments[1]);
        const WrittenResults results = write_results(sample_report(), staged.path());
        // The same page as a build without node writes it, for the browser test.
        PageOptions plain;
        plain.interactive = false;
        for (const auto& file : results.files) {
            if (file.extension() != ".svg") continue;
            plain.drawings[file.stem().string()] = read_text(staged.path() / file);
        }
        write_file(staged.path() / "plain.html", page_html(sample_report(), plain));
        staged.commit("report.html");
        for (const auto& status : results.statuses) std::puts(status.sentence.c_str());
        std::fputs(table_plain(gains()).c_str(), stdout);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
