// SPDX-License-Identifier: MIT
#include "verdigris/results/characterization_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "verdigris/results/cells.h"

namespace verdigris {
namespace {
using Json = nlohmann::ordered_json;

// Two directions with their intervals have to fit on a page; CSV and JSON hold every digit.
constexpr NumberFormat kWhole{NumberStyle::percent, 0, true};
constexpr NumberFormat kShare{NumberStyle::percent, 1, false};

std::string group_title(const CharacterizationRow& row) {
    if (row.block == "context") return "frames observed";
    if (row.block == "family") return "color transform";
    if (row.block == "order") return "extrapolation";
    if (row.block == "ridge") return "ridge";
    const bool all = row.setting.find("all pixels") != std::string::npos;
    return all ? "only the specimen moves and counts; fitted to all pixels"
               : "only the specimen moves and counts; fitted to the specimen";
}

// Holding still on windows that no row before was scored on.
void add_holding_still(const CharacterizationRow& row, Table& table) {
    const std::string of = row.block == "context" ? row.setting : "the specimen";
    TableRow cells{TableCell("holding still, " + of)};
    for (const CharacterizationCell& cell : row.cells) {
        cells.emplace_back(cell.persistence);
        cells.emplace_back();
    }
    table.groups.back().rows.push_back(std::move(cells));
}

// A page is too narrow for every horizon.
std::vector<int> shown_horizons(int horizons) {
    std::vector<int> shown;
    for (const int k : {1, 5, 10, 20, 40, 60, 85})
        if (k < horizons) shown.push_back(k);
    shown.push_back(horizons);
    return shown;
}

FigureSeries curve(const std::string& name, const std::vector<double>& values, bool muted = false) {
    FigureSeries series{name, SeriesKind::line, {}, muted};
    for (std::size_t k = 0; k < values.size(); ++k)
        series.points.push_back({double(k + 1), values[k]});
    return series;
}

}  // namespace

Table characterization_table(const Characterization& table,
                             const CharacterizationVerdict& verdict) {
    Table out;
    out.id = "characterization";
    out.title = "What the closed-form forecaster needs";
    out.caption =
        "Foreground MSE of affinergb and its gain over holding still on the same windows, with "
        "nominal 95 % block intervals. One axis varies per block of rows; \u2020 marks what is "
        "used everywhere else. Unregularized and unclamped except under ridge.";
    out.note =
        "Windows shift with the number of frames observed, and so does holding still. By "
        "default 60 windows per recording count (--windows all: every one); one unusual "
        "window weighs more among few, so numbers differ from those of `evaluate`.";
    out.group_header = "axis";
    out.columns = {{"setting", "Setting", Align::left}};
    for (std::size_t i = 0; i < table.directions.size(); ++i) {
        // A line may break after the hyphen of "->", so here it is one character.
        std::string direction = table.directions[i];
        if (const auto at = direction.rfind(" -> "); at != std::string::npos)
            direction.replace(at, 4, " \u2192 ");
        out.columns.push_back({fmt::format("error_{}", i + 1), direction, Align::right, kError});
        out.columns.push_back({fmt::format("gain_{}", i + 1), "gain", Align::right, kWhole, true});
    }
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const CharacterizationRow& row = table.rows[r];
        const std::string title = group_title(row);
        if (out.groups.empty() || out.groups.back().title != title)
            out.groups.push_back({title, {}});
        const std::string setting = row.setting.substr(0, row.setting.find(", fitted"));
        TableRow cells{TableCell(setting + (row.usual ? " \u2020" : ""))};
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            cells.emplace_back(row.cells[i].error);
            cells.push_back(cell_of(verdict.gains[r][i]));
        }
        out.groups.back().rows.push_back(std::move(cells));
        const bool last = r + 1 == table.rows.size() || group_title(table.rows[r + 1]) != title;
        if (last && row.block == "context") {
            for (const CharacterizationRow& context : table.rows)
                if (context.block == "context") add_holding_still(context, out);
        } else if (last && row.block == "fit-pixels") {
            add_holding_still(row, out);
        }
    }
    for (std::size_t i = 0; i < table.directions.size(); ++i)
        mark_best(out, fmt::format("gain_{}", i + 1), Better::higher);
    return out;
}

Table long_horizon_table(const CharacterizationVerdict& verdict) {
    Table table;
    table.id = "long-horizons";
    table.title = "Long horizons";
    table.caption =
        "Foreground MSE far beyond what was observed, the gain of the unclamped forecast, the "
        "share of its pixels outside [0, 1] (and outside by more than an 8-bit step), and how far "
        "the specimen has moved (mean absolute change, encoded sRGB).";
    table.group_header = "direction";
    table.columns = {{"horizon", "Horizon", Align::right, kCount},
                     {"persistence", "holding still", Align::right, kError},
                     {"clamped", "clamped", Align::right, kError},
                     {"unclamped", "unclamped", Align::right, kError},
                     {"gain", "gain", Align::right, kGain},
                     {"outside", "outside", Align::right, kShare},
                     {"outside_by_a_step", "by a step", Align::right, kShare},
                     {"moved", "moved", Align::right, {NumberStyle::fixed, 4, false}}};
    for (const LongVerdict& v : verdict.far) {
        RowGroup group{v.direction, {}};
        for (const int horizon :
             v.unclamped.empty() ? std::vector<int>() : shown_horizons(v.horizons)) {
            const std::size_t k = std::size_t(horizon - 1);
            group.rows.push_back(
                {TableCell(horizon), TableCell(v.persistence[k]), TableCell(v.clamped[k]),
                 TableCell(v.unclamped[k]), TableCell(gain_over(v.unclamped[k], v.persistence[k])),
                 v.outside.empty() ? TableCell() : TableCell(v.outside[k]),
                 v.outside.empty() ? TableCell() : TableCell(v.outside_by_a_step[k]),
                 TableCell(v.moved[k])});
        }
        table.groups.push_back(std::move(group));
    }
    return table;
}

Figure context_figure(const Characterization& table, const CharacterizationVerdict& verdict) {
    Figure figure;
    figure.id = "contexts";
    figure.title = "Gain by frames observed";
    figure.caption = "Bars: nominal 95 % block intervals, which cover less than they say.";
    for (std::size_t i = 0; i < table.directions.size(); ++i) {
        FigurePanel panel;
        panel.title = table.directions[i];
        panel.x = {.label = "frames observed"};
        panel.y = {.label = "gain over persistence", .format = kGain};
        FigureSeries series{"affinergb", SeriesKind::points, {}};
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            if (table.rows[r].block != "context" || !std::isfinite(verdict.gains[r][i].value))
                continue;
            const Resolved& gain = verdict.gains[r][i];
            series.points.push_back(
                interval_point(double(panel.x.categories.size()), gain.value, gain.block));
            panel.x.categories.push_back(fmt::format("{}", table.rows[r].context));
        }
        if (series.points.empty()) continue;
        panel.series.push_back(std::move(series));
        panel.references.push_back({"persistence", 0});
        figure.panels.push_back(std::move(panel));
    }
    never_empty(figure);
    return figure;
}

Figure long_horizon_figure(const CharacterizationVerdict& verdict) {
    Figure figure;
    figure.id = "errors-far";
    figure.title = "Error by horizon";
    figure.caption =
        "Foreground MSE against the horizon on a logarithmic scale; holding still is gray.";
    for (const LongVerdict& v : verdict.far) {
        if (v.unclamped.empty()) continue;
        FigurePanel panel;
        panel.title = v.direction;
        panel.x = {.label = "horizon (units)"};
        panel.y = {.label = "foreground MSE", .scale = AxisScale::log10, .format = kError};
        panel.series = {curve("persistence", v.persistence, true),
                        curve("affinergb unclamped", v.unclamped),
                        curve("affinergb clamped", v.clamped)};
        figure.panels.push_back(std::move(panel));
    }
    never_empty(figure);
    return figure;
}

Figure out_of_gamut_figure(const CharacterizationVerdict& verdict) {
    Figure figure;
    figure.id = "out-of-gamut";
    figure.title = "Pixels that leave [0, 1]";
    figure.caption =
        "Share of the unclamped forecast's pixels with a channel outside [0, 1], and outside by "
        "more than an 8-bit step.";
    for (const LongVerdict& v : verdict.far) {
        if (v.outside.empty()) continue;
        FigurePanel panel;
        panel.title = v.direction;
        panel.x = {.label = "horizon (units)"};
        panel.y = {.label = "share of pixels", .lo = 0.0, .format = kShare};
        // A flat zero still needs an axis that shows it as such.
        if (*std::max_element(v.outside.begin(), v.outside.end()) < 0.01) panel.y.hi = 0.01;
        panel.series = {curve("outside", v.outside),
                        curve("by more than a step", v.outside_by_a_step)};
        figure.panels.push_back(std::move(panel));
    }
    never_empty(figure);
    return figure;
}

Table characterization_windows(const Characterization& table) {
    Table out;
    out.id = "windows_characterization";
    out.title = "Every window of every setting";
    out.caption = "Foreground MSE, mean over horizons.";
    out.columns = {{"axis", "axis", Align::left},
                   {"setting", "setting", Align::left},
                   {"direction", "direction", Align::left},
                   {"start", "start", Align::right, kCount},
                   {"error", "error"},
                   {"persistence", "persistence"}};
    for (const CharacterizationRow& row : table.rows) {
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            const WindowRatios& w = row.cells[i].ratios;
            for (std::size_t k = 0; k < w.starts.size(); ++k)
                out.add_row({TableCell(row.block), TableCell(row.setting),
                             TableCell(table.directions[i]), TableCell(w.starts[k]),
                             TableCell(w.under[k] - w.over[k]), TableCell(w.under[k])});
        }
    }
    return out;
}

Report characterization_report(const EvaluationProtocol& p, const Characterization& table,
                               const CharacterizationVerdict& verdict) {
    Report report;
    report.title = "What the closed-form forecaster needs";
    report.subtitle = fmt::format(
        "{} observed frames unless said otherwise, {} forecast, {} samples per unit. Units are "
        "fractions of the observed recording, not calendar time.",
        p.context, p.horizons, p.stride);
    ReportSection words{"verdict", "Verdict", {}};
    words.blocks.push_back(BulletList{verdict.sentences});
    if (p.single)
        words.blocks.push_back(Paragraph{
            "Within-recording: nothing is trained, but what is chosen here while looking at these "
            "recordings is not judged by them."});
    words.blocks.push_back(Paragraph{
        "What is best in a table was chosen after looking at it. Intervals come from few blocks "
        "and cover less than their nominal 95 % (docs/PROTOCOL.md)."});
    for (const Status& s : table.notes) words.blocks.push_back(s);
    report.sections.push_back(std::move(words));
    report.sections.push_back(
        {"section-settings",
         "Context, family, order, pixels, ridge",
         {characterization_table(table, verdict), context_figure(table, verdict)}});
    report.sections.push_back(
        {"section-far",
         "Long horizons",
         {long_horizon_figure(verdict), long_horizon_table(verdict), out_of_gamut_figure(verdict),
          Paragraph{"The foreground here is what changes within these horizons, so errors at short "
                    "horizons differ from those above. The protocol as it was applied is in "
                    "protocol.toml."}}});
    return report;
}

Json json_of(const EvaluationProtocol& p, const Characterization& table,
             const CharacterizationVerdict& verdict) {
    Json protocol = protocol_json(p);
    protocol["max_windows"] = p.max_windows;
    Json out = {{"protocol", std::move(protocol)}, {"directions", table.directions},
                {"rows", Json::array()},           {"long_horizons", Json::object()},
                {"verdict", verdict.sentences},    {"notes", notes_json(table.notes)}};
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const CharacterizationRow& row = table.rows[r];
        Json cells = Json::object();
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            Json cell = json_of(verdict.gains[r][i]);
            cell["error"] = row.cells[i].error;
            cell["persistence"] = row.cells[i].persistence;
            cells[table.directions[i]] = std::move(cell);
        }
        out["rows"].push_back({{"axis", row.block},
                               {"setting", row.setting},
                               {"context", row.context},
                               {"usual", row.usual},
                               {"directions", std::move(cells)}});
    }
    for (const LongVerdict& v : verdict.far)
        out["long_horizons"][v.direction] = {
            {"horizons", v.horizons},
            {"windows", v.windows},
            {"windows_independent", v.independent},
            {"persistence", numbers_json(v.persistence)},
            {"clamped", numbers_json(v.clamped)},
            {"unclamped", numbers_json(v.unclamped)},
            {"outside", numbers_json(v.outside)},
            {"outside_by_a_step", numbers_json(v.outside_by_a_step)},
            {"moved", numbers_json(v.moved)},
            {"crossings", v.crossings}};
    return out;
}

}  // namespace verdigris
