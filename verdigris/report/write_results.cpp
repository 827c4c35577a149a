// SPDX-License-Identifier: MIT
#include "verdigris/report/write_results.h"

#include <cstdint>
#include <set>
#include <string_view>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"
#include "verdigris/report/draw_figure.h"
#include "verdigris/report/figure_layout.h"
#include "verdigris/report/table_formats.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

class ResultsWriter {
  public:
    ResultsWriter(const fs::path& folder, const Progress& progress, std::int64_t total)
        : folder_(folder), progress_(progress), total_(total) {}

    void table(const Table& given, bool shown) {
        step();
        const std::string stem = "tables/" + given.id;
        write_csv(folder_ / (stem + ".csv"), table_csv(given));
        out_.files.emplace_back(stem + ".csv");
        if (!shown) return;
        text(stem + ".json", table_json(given));
        text(stem + ".tex", table_latex(given));
    }
    void figure(const Figure& given) {
        step();
        const int left_out = layout_figure(given).left_out;
        if (left_out > 0) {
            const bool one = left_out == 1;
            out_.statuses.push_back({"points_left_out", Severity::caution,
                                     "Figure '" + given.title + "' leaves out " +
                                         std::to_string(left_out) +
                                         (one ? " point that is" : " points that are") +
                                         " not finite, or not above zero on a logarithmic axis."});
        }
        if (!gnuplot_) return;
        const std::string stem = "figures/" + given.id;
        std::string svg = draw_figure(given, FigureFormat::svg);
        text(stem + ".svg", svg);
        text(stem + ".png", draw_figure(given, FigureFormat::png));
        drawings_[given.id] = std::move(svg);
    }
    void picture(const Picture& given) { text("figures/" + given.id + ".png", given.png); }
    WrittenResults page(const Report& report, bool has_figures) {
        step();
        if (has_figures && !gnuplot_) {
            std::string sentence =
                "Figures were not drawn because gnuplot is missing: install the package "
                "gnuplot-nox and run again.";
            if (report_is_interactive()) sentence += " Their charts are on the page only.";
            out_.statuses.push_back({"figures_left_out", Severity::caution, std::move(sentence)});
        }
        if (!report_is_interactive()) {
            out_.statuses.push_back(
                {"page_is_static", Severity::info,
                 "The charts of this page do not answer to the pointer, because this program was "
                 "built without node."});
        }
        PageOptions options;
        options.drawings = std::move(drawings_);
        options.links = true;
        text("report.html", page_html(with_statuses(report), options));
        return std::move(out_);
    }

  private:
    void step() { verdigris::report(progress_, "report", done_++, total_); }
    void text(const std::string& name, std::string_view content) {
        write_file(folder_ / name, content);
        out_.files.emplace_back(name);
    }
    // Whoever reads the page should not have to read the terminal too.
    Report with_statuses(const Report& given) const {
        Report shown = given;
        if (out_.statuses.empty()) return shown;
        if (shown.sections.empty()) shown.sections.push_back({"about", "About this page", {}});
        auto& blocks = shown.sections.front().blocks;
        blocks.insert(blocks.begin(), out_.statuses.begin(), out_.statuses.end());
        return shown;
    }

    const fs::path folder_;
    const Progress& progress_;
    const std::int64_t total_;
    const bool gnuplot_ = gnuplot_is_installed();
    std::int64_t done_ = 0;
    std::map<std::string, std::string> drawings_;
    WrittenResults out_;
};

}  // namespace

WrittenResults write_results(const Report& report, const fs::path& folder,
                             const std::vector<Table>& data_tables, const Progress& progress) {
    check_report(report);
    std::vector<const Table*> tables;
    std::vector<const Figure*> figures;
    std::vector<const Picture*> pictures;
    std::set<std::string> names;
    for (const ReportSection& section : report.sections) {
        for (const ReportBlock& block : section.blocks) {
            if (const auto* table = std::get_if<Table>(&block)) tables.push_back(table);
            if (const auto* figure = std::get_if<Figure>(&block)) figures.push_back(figure);
            if (const auto* picture = std::get_if<Picture>(&block)) pictures.push_back(picture);
        }
    }
    for (const Table* table : tables) names.insert(table->id);
    for (const Table& table : data_tables) {
        check_table(table);
        if (!names.insert(table.id).second) {
            throw Error(ErrorCode::failed, "is written twice", "table '" + table.id + "'");
        }
    }
    ResultsWriter writer(folder, progress,
                         std::int64_t(tables.size() + data_tables.size() + figures.size() + 1));
    for (const Table* table : tables) writer.table(*table, true);
    for (const Table& table : data_tables) writer.table(table, false);
    for (const Figure* figure : figures) writer.figure(*figure);
    for (const Picture* picture : pictures) writer.picture(*picture);
    return writer.page(report, !figures.empty());
}

}  // namespace verdigris
