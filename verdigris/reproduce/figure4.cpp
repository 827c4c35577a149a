// SPDX-License-Identifier: MIT
// Figure 4: is it the copper, or the camera?
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/reproduce/compare.h"
#include "verdigris/reproduce/ours.h"
#include "verdigris/reproduce/paper_values.h"
#include "verdigris/reproduce/sections.h"
#include "verdigris/results/cells.h"

namespace verdigris {
namespace {

constexpr std::array<const char*, 4> kCorrections{"none", "gain", "offset", "both"};

/// Direction d is judged on recording 1 - d.
std::string judged_on(int d) {
    return d == kChamberToAir ? "air" : "chamber";
}

const Resolved* gain_of(const std::vector<OursDrift>& ours, int d, const std::string& correction) {
    if (std::size_t(1 - d) >= ours.size()) return nullptr;
    const auto& gains = ours[std::size_t(1 - d)].gains;
    const auto found = gains.find(correction);
    return found == gains.end() ? nullptr : &found->second;
}

Table movement_table(const Reproduced& r, const std::vector<OursDrift>& ours) {
    constexpr NumberFormat kValue{NumberStyle::significant, 3, false};
    Table table;
    table.id = "figure4-movement";
    table.title = "Figure 4, left: specimen and reference";
    table.caption =
        "How far the mean color of the specimen and of the backdrop moves over a recording "
        "(encoded sRGB, of full scale), their ratio, and the correlation of their lightness." +
        r.caution();
    table.group_header = "recording";
    table.columns = {{"what", "What", Align::left},
                     {"paper", "paper", Align::right, kValue},
                     {"ours", "ours", Align::right, kValue}};
    for (const int d : {kAirToChamber, kChamberToAir}) {
        const OursDrift* mine =
            std::size_t(1 - d) < ours.size() ? &ours[std::size_t(1 - d)] : nullptr;
        RowGroup group{fmt::format("{}; ours {}", judged_on(d), r.recording(1 - d)), {}};
        const auto row = [&](const char* title, const char* column, std::optional<double> value) {
            // Its own digits: 0.001 is not 0.00100.
            TableCell paper = not_printed();
            for (const PaperValue& v : paper_values())
                if (std::string_view(v.item) == "figure4" && v.direction == d &&
                    std::string_view(v.row) == "recording" && std::string_view(v.column) == column)
                    paper = TableCell(v.printed);
            group.rows.push_back({TableCell(title), paper, cell_or_missing(value)});
        };
        row("specimen", "specimen", mine ? mine->specimen : std::nullopt);
        row("reference", "reference", mine ? mine->reference : std::nullopt);
        row("ratio", "ratio", mine ? mine->ratio : std::nullopt);
        row("correlation", "correlation", mine ? mine->correlation : std::nullopt);
        table.groups.push_back(std::move(group));
    }
    return table;
}

Table gains_table(const Reproduced& r, const std::vector<OursDrift>& ours) {
    Table table;
    table.id = "figure4-gains";
    table.title = "Figure 4, right: affinergb with the drift taken out";
    table.caption =
        "Gain of affinergb over holding still, as recorded and after the drift seen on the "
        "backdrop was taken out. Intervals: nominal 95 %, of blocks; the paper gives one of what "
        "is as recorded in its text." +
        r.caution();
    table.group_header = "judged on";
    table.columns = {{"correction", "Correction", Align::left},
                     {"paper", "paper", Align::right, kGain, true},
                     {"ours", "ours", Align::right, kGain, true}};
    for (const int d : {kChamberToAir, kAirToChamber}) {
        RowGroup group{fmt::format("{}; ours {}", judged_on(d), r.recording(1 - d)), {}};
        for (const char* correction : kCorrections) {
            const double printed = *paper_share("figure4", d, "affinergb", correction);
            TableCell paper(printed);
            if (std::string(correction) == "none")
                paper =
                    TableCell(printed, {*paper_share("intervals", d, "affinergb", "block_low"),
                                        *paper_share("intervals", d, "affinergb", "block_high")});
            const Resolved* gain = gain_of(ours, d, correction);
            group.rows.push_back(
                {TableCell(correction), paper, gain ? cell_of(*gain) : TableCell()});
        }
        table.groups.push_back(std::move(group));
    }
    return table;
}

/// Ours only: the paper prints its curves as a drawing.
Figure series_figure(const Reproduced& r, const std::vector<OursSeries>& ours) {
    Figure figure;
    figure.id = "figure4-series";
    figure.title = "Figure 4, left";
    figure.caption =
        "Mean color of the specimen and of the backdrop (reference, gray) over each recording of "
        "ours, encoded sRGB, as measured. The paper prints its curves as a drawing; how far both "
        "move stands above." +
        r.caution();
    for (const OursSeries& series : ours) {
        FigurePanel panel;
        panel.title = series.recording;
        panel.x = {.label = "sample"};
        panel.y = {.label = "mean, encoded sRGB"};
        for (const auto& [name, values] : series.values) {
            const bool reference = name.starts_with("reference_");
            if (reference && name != "reference_green") continue;
            // As many as a page can show.
            const std::size_t step = std::max<std::size_t>(1, values.size() / 300);
            FigureSeries line{reference ? "reference, green" : "specimen, " + name.substr(9),
                              SeriesKind::line,
                              {},
                              reference};
            for (std::size_t t = 0; t < values.size(); t += step)
                line.points.push_back({double(t), values[t]});
            panel.series.push_back(std::move(line));
        }
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

Figure gains_figure(const Reproduced& r, const std::vector<OursDrift>& ours) {
    Figure figure;
    figure.id = "figure4";
    figure.title = "Figure 4, right";
    figure.caption =
        "affinergb's gain over holding still before and after correction. Bars: nominal 95 % "
        "block intervals, of ours where there are five blocks or more." +
        r.caution();
    for (const int d : {kChamberToAir, kAirToChamber}) {
        FigurePanel panel;
        panel.title = "judged on " + judged_on(d);
        panel.x = {.label = "correction", .categories = {kCorrections.begin(), kCorrections.end()}};
        panel.y = {.label = "gain over persistence", .format = kGain};
        panel.references.push_back({"persistence", 0});
        FigureSeries paper{"paper", SeriesKind::points, {}}, mine{"ours", SeriesKind::points, {}};
        for (std::size_t c = 0; c < kCorrections.size(); ++c) {
            FigurePoint p{double(c), *paper_share("figure4", d, "affinergb", kCorrections[c])};
            if (c == 0)
                p.bounds = Bounds{*paper_share("intervals", d, "affinergb", "block_low"),
                                  *paper_share("intervals", d, "affinergb", "block_high")};
            paper.points.push_back(p);
            if (const Resolved* gain = gain_of(ours, d, kCorrections[c]))
                mine.points.push_back(
                    interval_point(double(c), gain->value,
                                   gain->blocks.size() >= kFewBlocks ? gain->block : std::nullopt));
        }
        panel.series.push_back(std::move(paper));
        if (!mine.points.empty()) panel.series.push_back(std::move(mine));
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

}  // namespace

ReportSection figure4_section(const Reproduced& r) {
    ReportSection section{"section-figure4", "Figure 4: is it the camera?", {}};
    std::vector<std::string> problems;
    const auto read = ours_or_reason(r, "drift", read_ours_drift, problems);
    const std::vector<OursDrift> ours = read.value_or(std::vector<OursDrift>());
    BulletList list;
    for (const int d : {kChamberToAir, kAirToChamber})
        for (const char* correction : kCorrections)
            if (const Resolved* gain = gain_of(ours, d, correction))
                list.items.push_back(compare_gain(
                    fmt::format("judged on {}, correction {}", judged_on(d), correction),
                    *paper_share("figure4", d, "affinergb", correction), *gain));
    if (!list.items.empty()) section.blocks.push_back(std::move(list));
    add_problems(problems, section);
    section.blocks.push_back(movement_table(r, ours));
    std::vector<std::string> told;  // above, if there is no drift at all
    const auto series = ours_or_reason(r, "drift", read_ours_series, told);
    if (series && !series->empty())
        section.blocks.push_back(series_figure(r, *series));
    else if (read)
        add_problems(told, section);
    section.blocks.push_back(gains_figure(r, ours));
    section.blocks.push_back(gains_table(r, ours));
    add_commands(r, {"drift"}, section);
    return section;
}

}  // namespace verdigris
