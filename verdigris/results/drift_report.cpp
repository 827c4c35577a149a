// SPDX-License-Identifier: MIT
#include "verdigris/results/drift_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "verdigris/results/cells.h"

namespace verdigris {
namespace {
using Json = nlohmann::ordered_json;

constexpr NumberFormat kShare{NumberStyle::percent, 2, false};
constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};
// Series take their inks in order, and these are the inks of blue, red and green (palette.h).
constexpr std::array<std::size_t, 3> kDrawn{2, 0, 1};

FigureSeries channel(const std::string& name, const std::vector<ChannelValues>& values,
                     std::size_t c, int stride, double less = 0) {
    FigureSeries series{name, SeriesKind::line, {}};
    // chosen: a curve of 300 points is a curve; smoothed ones need no more.
    const std::size_t step = std::max<std::size_t>(1, values.size() / 300);
    for (std::size_t t = 0; t < values.size(); t += step)
        series.points.push_back({double(t) / stride, values[t][c] - less});
    return series;
}

FigurePanel color_panel(const RecordingDrift& drift) {
    FigurePanel panel;
    panel.title = drift.name + ": mean color";
    panel.x = {.label = "units"};
    panel.y = {.label = "encoded sRGB", .format = {NumberStyle::fixed, 3, false}};
    for (const std::size_t c : kDrawn)
        panel.series.push_back(channel(fmt::format("specimen {}", kChannels[c]),
                                       drift.series->specimen, c, drift.stride));
    // One curve: a neutral backdrop's channels would hide one another. reference_figure() parts
    // them.
    std::vector<ChannelValues> gray = drift.series->reference;
    for (ChannelValues& v : gray) v[0] = (v[0] + v[1] + v[2]) / 3;
    panel.series.push_back(channel("reference", gray, 0, drift.stride));
    panel.series.back().muted = true;
    return panel;
}

FigurePanel gain_panel(const RecordingDrift& drift) {
    FigurePanel panel;
    panel.title = drift.name + ": gain over persistence";
    panel.x = {.label = "correction"};
    panel.y = {.label = "gain over persistence", .format = kGain};
    for (const DriftGain& g : drift.gains) {
        const std::string name = to_string(g.correction);
        auto& categories = panel.x.categories;
        auto at = std::ranges::find(categories, name);
        if (at == categories.end()) at = categories.insert(at, name);
        const double x = double(at - categories.begin());
        auto series = std::ranges::find(panel.series, g.forecaster, &FigureSeries::name);
        if (series == panel.series.end())
            series = panel.series.insert(series, {g.forecaster, SeriesKind::points, {}});
        if (!std::isfinite(g.gain.value)) continue;
        series->points.push_back(interval_point(x, g.gain.value, g.gain.block));
    }
    panel.references.push_back({"persistence", 0});
    return panel;
}

}  // namespace

Table drift_table(const std::vector<RecordingDrift>& list) {
    Table table;
    table.id = "drift";
    table.title = "Movement of specimen and reference";
    table.caption =
        "Pixels of the reference and their distance from the specimen, of the usual one; how far "
        "the "
        "smoothed mean colors went from their start, mean of the channels, of full scale; "
        "Pearson's correlation of the lightness of both over the samples, as measured and "
        "smoothed. The reference is found in the first 20 samples by its looks.";
    table.columns = {
        {"recording", "Recording", Align::left},
        {"reference_pixels", "pixels", Align::right, kCount},
        {"margin", "margin", Align::right, {NumberStyle::fixed, 2, false}},
        {"specimen", "specimen", Align::right, kShare},
        {"reference", "reference", Align::right, kShare},
        {"ratio", "ratio", Align::right, {NumberStyle::significant, 3, false}},
        {"correlation", "correlation", Align::right, {NumberStyle::fixed, 2, true}},
        {"smooth_correlation", "smoothed", Align::right, {NumberStyle::fixed, 2, true}}};
    for (const RecordingDrift& d : list) {
        TableRow row{TableCell(d.name)};
        if (d.series) {
            row.emplace_back(double(d.region.pixels));
            row.emplace_back(d.region.margin);
            row.emplace_back(d.series->specimen_movement);
            row.emplace_back(d.series->reference_movement);
            row.push_back(cell_or_missing(d.series->ratio));
            row.push_back(cell_or_missing(d.series->luma_correlation));
            row.push_back(cell_or_missing(d.series->smooth_luma_correlation));
        } else {
            row.resize(table.columns.size());
        }
        table.add_row(std::move(row));
    }
    return table;
}

Table drift_gain_table(const std::vector<RecordingDrift>& list) {
    Table table;
    table.id = "drift-gains";
    table.title = "Gains before and after correction";
    table.caption =
        "Gain over persistence within each recording, with nominal 95 % block intervals; noise and "
        "threshold measured again after each correction.";
    table.group_header = "recording";
    table.columns = {
        {"forecaster", "Forecaster", Align::left},    {"correction", "Correction", Align::left},
        {"windows", "windows", Align::right, kCount}, {"error", "error", Align::right, kError},
        {"gain", "gain", Align::right, kGain, true},  {"blocks", "better in", Align::left}};
    for (const RecordingDrift& d : list) {
        RowGroup group{d.name, {}};
        for (const DriftGain& g : d.gains) {
            group.rows.push_back({TableCell(g.forecaster), TableCell(to_string(g.correction)),
                                  TableCell(g.gain.windows), finite_or_missing(g.error),
                                  cell_of(g.gain), TableCell(blocks_better(g.gain.blocks))});
        }
        table.groups.push_back(std::move(group));
    }
    return table;
}

Figure drift_figure(const std::vector<RecordingDrift>& list) {
    Figure figure;
    figure.id = "camera";
    figure.title = "Is it the camera?";
    figure.caption =
        "Left: mean color of specimen and reference (gray: mean of its channels), as measured. "
        "Right: gain "
        "over persistence as recorded and after correction, with nominal 95 % block intervals.";
    for (const RecordingDrift& d : list) {
        if (d.series) figure.panels.push_back(color_panel(d));
        figure.panels.push_back(gain_panel(d));
    }
    return figure;
}

Figure reference_figure(const std::vector<RecordingDrift>& list) {
    Figure figure;
    figure.id = "reference";
    figure.title = "The reference by itself";
    figure.caption = "Its mean color less that of its start, smoothed: what is taken out.";
    for (const RecordingDrift& d : list) {
        if (!d.series) continue;
        FigurePanel panel;
        panel.title = d.name;
        panel.x = {.label = "units"};
        panel.y = {.label = "change, of full scale", .format = {NumberStyle::percent, 2, true}};
        for (const std::size_t c : kDrawn)
            panel.series.push_back(channel(fmt::format("reference {}", kChannels[c]),
                                           d.series->smooth_reference, c, d.stride,
                                           d.series->smooth_reference.front()[c]));
        figure.panels.push_back(std::move(panel));
    }
    return figure;
}

Table drift_series_table(const std::vector<RecordingDrift>& list) {
    Table table;
    table.id = "drift_series";
    table.title = "Mean colors by sample";
    table.columns = {{"recording", "recording", Align::left}, {"sample", "sample"}};
    struct Part {
        const char* name;
        std::vector<ChannelValues> DriftSeries::*values;
    };
    const std::array<Part, 6> parts{{{"specimen", &DriftSeries::specimen},
                                     {"reference", &DriftSeries::reference},
                                     {"spread", &DriftSeries::spread},
                                     {"smooth_specimen", &DriftSeries::smooth_specimen},
                                     {"smooth_reference", &DriftSeries::smooth_reference},
                                     {"smooth_spread", &DriftSeries::smooth_spread}}};
    for (const Part& part : parts)
        for (const char* c : kChannels)
            table.columns.push_back({fmt::format("{}_{}", part.name, c), c});
    for (const RecordingDrift& d : list) {
        if (!d.series) continue;
        for (std::size_t t = 0; t < d.series->reference.size(); ++t) {
            TableRow row{TableCell(d.name), TableCell(double(t))};
            for (const Part& part : parts)
                for (std::size_t c = 0; c < 3; ++c)
                    row.emplace_back(((*d.series).*part.values)[t][c]);
            table.add_row(std::move(row));
        }
    }
    return table;
}

Table drift_map_table(const std::vector<RecordingDrift>& list) {
    Table table;
    table.id = "drift_gains";
    table.title = "Corrections by sample";
    table.columns = {{"recording", "recording", Align::left},
                     {"correction", "correction", Align::left},
                     {"sample", "sample"}};
    for (const char* part : {"gain", "offset"})
        for (const char* c : kChannels) table.columns.push_back({fmt::format("{}_{}", part, c), c});
    for (const RecordingDrift& d : list) {
        for (const auto& [correction, maps] : d.maps) {
            for (std::size_t t = 0; t < maps.size(); ++t) {
                TableRow row{TableCell(d.name), TableCell(to_string(correction)),
                             TableCell(double(t))};
                for (const double v : maps[t].gain) row.emplace_back(v);
                for (const double v : maps[t].offset) row.emplace_back(v);
                table.add_row(std::move(row));
            }
        }
    }
    return table;
}

Table drift_windows(const std::vector<RecordingDrift>& list) {
    Table table;
    table.id = "windows_drift";
    table.title = "Every window, as recorded and corrected";
    table.columns = {{"recording", "recording", Align::left},
                     {"forecaster", "forecaster", Align::left},
                     {"correction", "correction", Align::left},
                     {"start", "start"},
                     {"error", "error"},
                     {"persistence", "persistence"}};
    for (const RecordingDrift& d : list) {
        for (const DriftGain& g : d.gains) {
            const WindowRatios& w = g.ratios;
            for (std::size_t i = 0; i < w.starts.size(); ++i)
                table.add_row({TableCell(d.name), TableCell(g.forecaster),
                               TableCell(to_string(g.correction)), TableCell(w.starts[i]),
                               TableCell(w.under[i] - w.over[i]), TableCell(w.under[i])});
        }
    }
    return table;
}

Report drift_report(const EvaluationProtocol& p, const std::vector<RecordingDrift>& list) {
    Report report;
    report.title = "Is it the copper or the camera?";
    report.subtitle = fmt::format(
        "Within each recording: {} observed frames, {} forecast, {} samples per unit. Units are "
        "fractions of the observed recording, not calendar time.",
        p.context, p.horizons, p.stride);
    ReportSection verdict{"verdict", "Verdict", {}};
    BulletList sentences;
    for (const RecordingDrift& d : list)
        sentences.items.insert(sentences.items.end(), d.sentences.begin(), d.sentences.end());
    verdict.blocks.push_back(std::move(sentences));
    verdict.blocks.push_back(Paragraph{
        "Intervals come from few blocks and cover less than their nominal 95 % "
        "(docs/PROTOCOL.md). A drift that the backdrop does not show, such as a lamp that only the "
        "specimen faces, is not seen here."});
    for (const RecordingDrift& d : list)
        for (const Status& s : d.notes) verdict.blocks.push_back(s);
    report.sections.push_back(std::move(verdict));
    report.sections.push_back({"section-camera", "Before and after", {drift_figure(list)}});
    report.sections.back().blocks.emplace_back(drift_gain_table(list));
    ReportSection light{"section-light", "The light", {drift_table(list)}};
    const Figure reference = reference_figure(list);
    if (!reference.panels.empty()) light.blocks.emplace_back(reference);
    light.blocks.emplace_back(Paragraph{
        "The corrections of every sample are in drift_gains.csv (corrected = gain x + offset, "
        "encoded sRGB), the protocol as it was applied is in protocol.toml."});
    report.sections.push_back(std::move(light));
    return report;
}

Json json_of(const EvaluationProtocol& p, const std::vector<RecordingDrift>& list) {
    Json protocol = protocol_json(p);
    protocol["single"] = true;
    Json out = {{"protocol", std::move(protocol)}, {"recordings", Json::object()}};
    const auto optional = [](const std::optional<double>& v) {
        return v ? number_json(*v) : Json();
    };
    for (const RecordingDrift& d : list) {
        Json r = {{"reference",
                   {{"found", d.region.found()},
                    {"pixels", d.region.pixels},
                    {"margin", d.region.margin},
                    {"sentence", d.region.sentence}}},
                  {"movement", nullptr},
                  {"gains", Json::object()},
                  {"verdict", d.sentences},
                  {"notes", notes_json(d.notes)}};
        if (d.series)
            r["movement"] = {{"specimen", d.series->specimen_movement},
                             {"reference", d.series->reference_movement},
                             {"ratio", optional(d.series->ratio)},
                             {"correlation", optional(d.series->luma_correlation)},
                             {"smooth_correlation", optional(d.series->smooth_luma_correlation)}};
        for (const DriftGain& g : d.gains) {
            Json gain = json_of(g.gain);
            gain["error"] = number_json(g.error);
            gain["persistence"] = number_json(g.persistence);
            r["gains"][g.forecaster][to_string(g.correction)] = std::move(gain);
        }
        out["recordings"][d.name] = std::move(r);
    }
    return out;
}

}  // namespace verdigris
