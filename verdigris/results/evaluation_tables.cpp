// SPDX-License-Identifier: MIT
// The tables and figures of an evaluation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "verdigris/results/cells.h"
#include "verdigris/results/evaluation_report.h"
#include "verdigris/results/resolved.h"

namespace verdigris {
namespace {

constexpr NumberFormat kSmall{NumberStyle::fixed, 2, false};

double mean_or_nan(const ErrorTable& table) {
    return table.empty() || table.windows == 0 ? std::nan("") : overall_mean(table);
}

// The horizons worth a column: first, middle, last.
std::vector<int> shown_horizons(int horizons) {
    std::vector<int> shown{1, (horizons + 1) / 2, horizons};
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    return shown;
}

}  // namespace

Table error_table(const Evaluation& evaluation) {
    Table table;
    table.id = "errors";
    table.title = "Errors of each forecaster";
    table.caption =
        "Mean squared error over the pixels that change (foreground), encoded sRGB; gain over "
        "persistence as a ratio of means; over the whole specimen mean squared error, CIEDE2000 "
        "and "
        "bias (forecast less truth, mean of the channels). Means over windows, then over horizons.";
    table.group_header = "direction";
    table.columns = {{"forecaster", "Forecaster", Align::left}};
    const auto shown = shown_horizons(evaluation.protocol.horizons);
    for (const int k : shown)
        table.columns.push_back(
            {fmt::format("t{}", k), fmt::format("t+{}", k), Align::right, kError});
    table.columns.push_back({"mean", "mean", Align::right, kError});
    table.columns.push_back({"gain", "gain", Align::right, kGain});
    table.columns.push_back({"specimen", "specimen", Align::right, kError});
    table.columns.push_back({"delta_e", "CIEDE2000", Align::right, kSmall});
    table.columns.push_back({"bias", "bias", Align::right, {NumberStyle::fixed, 4, true}});
    for (const Direction& d : evaluation.directions) {
        RowGroup group;
        group.title = d.label();
        for (const EntrantScores& s : d.entrants) {
            TableRow row{TableCell(s.name)};
            const bool any = !d.starts.empty();
            const std::vector<double> means =
                any ? horizon_means(s.foreground) : std::vector<double>();
            for (const int k : shown)
                row.push_back(any ? TableCell(means[std::size_t(k - 1)]) : TableCell());
            row.push_back(finite_or_missing(mean_or_nan(s.foreground)));
            row.push_back(finite_or_missing(any ? gain(d, s) : std::nan("")));
            row.push_back(finite_or_missing(mean_or_nan(s.specimen)));
            row.push_back(finite_or_missing(mean_or_nan(s.delta_e)));
            row.push_back(finite_or_missing(
                (mean_or_nan(s.bias[0]) + mean_or_nan(s.bias[1]) + mean_or_nan(s.bias[2])) / 3));
            group.rows.push_back(std::move(row));
        }
        table.groups.push_back(std::move(group));
    }
    mark_best(table, "mean", Better::lower);
    return table;
}

Table coverage_table(const Evaluation& evaluation) {
    Table table;
    table.id = "coverage";
    table.title = "Coverage of the forecasters' own intervals";
    table.caption =
        "Share of the truth inside the nominal 80 % and 95 % intervals that a forecaster states: "
        "of "
        "channels of the specimen's pixels, and of its mean color. Means over windows.";
    table.group_header = "direction";
    constexpr NumberFormat share{NumberStyle::percent, 0, false};
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"horizon", "horizon", Align::left},
                     {"pixels_80", "pixels, 80 %", Align::right, share},
                     {"pixels_95", "pixels, 95 %", Align::right, share},
                     {"mean_80", "mean color, 80 %", Align::right, share},
                     {"mean_95", "mean color, 95 %", Align::right, share}};
    for (const Direction& d : evaluation.directions) {
        RowGroup group;
        group.title = d.label();
        for (const EntrantScores& s : d.entrants) {
            const std::vector<double> columns[] = {known_means(s.pixels80), known_means(s.pixels95),
                                                   known_means(s.mean80), known_means(s.mean95)};
            if (columns[0].empty() || !std::isfinite(columns[0].front())) continue;
            for (const int k : shown_horizons(evaluation.protocol.horizons)) {
                TableRow row{TableCell(s.name), TableCell(fmt::format("t+{}", k))};
                for (const auto& c : columns)
                    row.push_back(finite_or_missing(c[std::size_t(k - 1)]));
                group.rows.push_back(std::move(row));
            }
            TableRow row{TableCell(s.name), TableCell("all")};
            for (const auto& c : columns) {
                double sum = 0;
                for (const double v : c) sum += v;
                row.push_back(finite_or_missing(sum / double(c.size())));
            }
            group.rows.push_back(std::move(row));
        }
        if (!group.rows.empty()) table.groups.push_back(std::move(group));
    }
    return table;
}

Table interval_table(const std::vector<DirectionVerdict>& list) {
    Table table;
    table.id = "intervals";
    table.title = "Gains with intervals";
    table.caption =
        "Gain over persistence with nominal 95 % intervals by three bootstraps: windows one by one "
        "(naive, far too narrow), non-overlapping blocks, and blocks at any offset of the "
        "recording "
        "joined to a circle.";
    table.group_header = "direction";
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"block", "gain, blocks", Align::right, kGain, true},
                     {"circular_block", "circular blocks", Align::right, kGain, true},
                     {"naive", "naive", Align::right, kGain, true}};
    for (const DirectionVerdict& d : list) {
        RowGroup group;
        group.title = d.direction->label();
        for (const EntrantVerdict& e : d.entrants) {
            // Of fewer blocks an interval says nothing, and the sentences say so.
            const bool few = e.blocks.size() < kFewBlocks;
            group.rows.push_back({TableCell(e.name),
                                  interval_cell(e.gain, few ? std::nullopt : e.block),
                                  interval_cell(e.gain, few ? std::nullopt : e.circular_block),
                                  interval_cell(e.gain, e.naive)});
        }
        table.groups.push_back(std::move(group));
    }
    return table;
}

Table pair_table(const std::vector<DirectionVerdict>& list) {
    Table table;
    table.id = "pairs";
    table.title = "Forecasters against each other";
    table.caption =
        "Gain of the first less gain of the second, on the same windows, with nominal "
        "95 % intervals: positive where the first is better.";
    table.group_header = "direction";
    table.columns = {{"first", "First", Align::left},
                     {"second", "Second", Align::left},
                     {"block", "difference, blocks", Align::right, kGain, true},
                     {"circular_block", "circular blocks", Align::right, kGain, true}};
    for (const DirectionVerdict& d : list) {
        RowGroup group;
        group.title = d.direction->label();
        for (const PairVerdict& p : d.pairs)
            group.rows.push_back({TableCell(p.first), TableCell(p.second),
                                  interval_cell(p.difference, p.block),
                                  interval_cell(p.difference, p.circular_block)});
        table.groups.push_back(std::move(group));
    }
    return table;
}

Table block_table(const std::vector<DirectionVerdict>& list) {
    Table table;
    table.id = "blocks";
    table.title = "Gains by block";
    table.caption =
        "Gain over persistence of each block of windows by itself. Blocks are one "
        "window's span long; windows of neighboring blocks share samples.";
    table.group_header = "direction";
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"block", "Block", Align::left},
                     {"windows", "windows", Align::right, kCount},
                     {"gain", "gain", Align::right, kGain}};
    for (const DirectionVerdict& d : list) {
        RowGroup group;
        group.title = d.direction->label();
        for (const EntrantVerdict& e : d.entrants) {
            for (const BlockGain& b : e.blocks)
                group.rows.push_back(
                    {TableCell(e.name),
                     TableCell(fmt::format("samples {} to {}", b.first_start, b.last_start)),
                     TableCell(b.windows), finite_or_missing(b.value)});
            for (const EntrantVerdict::Named& n : e.named)
                group.rows.push_back({TableCell(e.name),
                                      TableCell(fmt::format("{} (units {:g} to {:g})", n.block.name,
                                                            n.block.begin, n.block.end)),
                                      TableCell(n.windows), finite_or_missing(n.gain)});
        }
        table.groups.push_back(std::move(group));
    }
    return table;
}

Table window_count_table(const Evaluation& evaluation) {
    Table table;
    table.id = "windows";
    table.title = "Windows";
    table.caption =
        "What was scored. Independent windows share no sample. Skipped windows have too "
        "few pixels that change; windows.csv names each one that was scored.";
    table.columns = {{"direction", "Direction", Align::left},
                     {"samples", "samples", Align::right, kCount},
                     {"usable", "usable", Align::right, kCount},
                     {"scored", "windows scored", Align::right, kCount},
                     {"skipped", "skipped", Align::right, kCount},
                     {"independent", "independent", Align::right, kCount},
                     {"sigma", "noise", Align::right, {NumberStyle::significant, 3, false}},
                     {"tau", "threshold", Align::right, {NumberStyle::significant, 3, false}}};
    std::map<std::string, int> reasons;
    for (const Direction& d : evaluation.directions) {
        table.add_row({TableCell(d.label()), TableCell(d.plan.samples),
                       TableCell(d.plan.usable.count()), TableCell(double(d.starts.size())),
                       TableCell(double(d.skipped.size())), TableCell(d.plan.independent),
                       TableCell(d.sigma), TableCell(d.tau)});
        for (const SkippedWindow& s : d.skipped) ++reasons[d.label() + ": " + s.why];
    }
    // The reasons quote pixel counts, so there can be many: the first tell enough.
    int told = 0;
    for (const auto& [why, count] : reasons) {
        if (++told > 3) break;
        table.note +=
            fmt::format("{}{} ({} window{})", told > 1 ? "; " : "Skipped, for example: ", why,
                        count, count == 1 ? "" : "s");
    }
    return table;
}

Table window_errors(const Evaluation& evaluation) {
    Table table;
    table.id = "windows_all";
    table.title = "Errors per window and horizon";
    table.columns = {{"direction", "direction", Align::left},
                     {"forecaster", "forecaster", Align::left},
                     {"start", "first sample", Align::right, kCount},
                     {"horizon", "horizon", Align::right, kCount},
                     {"foreground", "foreground MSE"},
                     {"specimen", "specimen MSE"},
                     {"absolute", "mean absolute error"},
                     {"delta_e", "CIEDE2000"},
                     {"bias_r", "bias r"},
                     {"bias_g", "bias g"},
                     {"bias_b", "bias b"}};
    RowGroup group;
    for (const Direction& d : evaluation.directions) {
        for (const EntrantScores& s : d.entrants) {
            for (int w = 0; w < s.foreground.windows; ++w) {
                for (int k = 0; k < s.foreground.horizons; ++k) {
                    group.rows.push_back(
                        {TableCell(d.label()), TableCell(s.name),
                         TableCell(d.starts[std::size_t(w)]), TableCell(k + 1),
                         TableCell(s.foreground.at(w, k)), TableCell(s.specimen.at(w, k)),
                         TableCell(s.absolute.at(w, k)),
                         s.delta_e.empty() ? TableCell() : TableCell(s.delta_e.at(w, k)),
                         TableCell(s.bias[0].at(w, k)), TableCell(s.bias[1].at(w, k)),
                         TableCell(s.bias[2].at(w, k))});
                }
            }
        }
    }
    table.groups.push_back(std::move(group));
    return table;
}

Figure horizon_figure(const Evaluation& evaluation) {
    Figure figure;
    figure.id = "horizons";
    figure.title = "Error by horizon";
    figure.caption = "Mean foreground error at each horizon, logarithmic. Persistence in gray.";
    for (const Direction& d : evaluation.directions) {
        if (d.starts.empty()) continue;
        FigurePanel panel;
        panel.title = d.label();
        panel.x = {.label = "horizon (units)"};
        panel.y = {.label = "foreground MSE", .scale = AxisScale::log10, .format = kError};
        for (const EntrantScores& s : d.entrants) {
            FigureSeries series{s.name, SeriesKind::line, {}, &s == &d.entrants.front()};
            const std::vector<double> means = horizon_means(s.foreground);
            for (std::size_t k = 0; k < means.size(); ++k)
                series.points.push_back({double(k + 1), means[k]});
            panel.series.push_back(std::move(series));
        }
        figure.panels.push_back(std::move(panel));
    }
    never_empty(figure);
    return figure;
}

Figure gain_figure(const std::vector<DirectionVerdict>& list) {
    Figure figure;
    figure.id = "gains";
    figure.title = "Gain over persistence";
    figure.caption =
        "Bars: nominal 95 % intervals over non-overlapping blocks, which cover less "
        "than they say.";
    for (const DirectionVerdict& d : list) {
        FigurePanel panel;
        panel.title = d.direction->label();
        panel.x = {.label = ""};
        panel.y = {.label = "gain over persistence", .format = kGain};
        FigureSeries series{"gain", SeriesKind::points, {}};
        for (const EntrantVerdict& e : d.entrants) {
            if (!std::isfinite(e.gain)) continue;
            series.points.push_back(
                interval_point(double(panel.x.categories.size()), e.gain,
                               e.blocks.size() < kFewBlocks ? std::nullopt : e.block));
            panel.x.categories.push_back(e.name);
        }
        panel.series.push_back(std::move(series));
        panel.references.push_back({"persistence", 0});
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

}  // namespace verdigris
