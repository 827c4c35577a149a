// SPDX-License-Identifier: MIT
#include "verdigris/learn/susceptibility_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;
constexpr NumberFormat kR{NumberStyle::fixed, 2, true};
constexpr int kEnlarged = 3, kGap = 6;
constexpr double kErrors = 2;  // standard errors that make a difference worth a word

TableCell cell(const Correlation& c) {
    if (!std::isfinite(c.error)) return TableCell(c.mean);
    return TableCell(c.mean, {c.mean - c.error, c.mean + c.error});
}

FigurePoint point(double x, const Correlation& c) {
    FigurePoint p{x, c.mean};
    if (std::isfinite(c.error)) p.bounds = Bounds{c.mean - c.error, c.mean + c.error};
    return p;
}

std::string printed(const Correlation& c) {
    const std::string mean = number_text(c.mean, kR);
    return std::isfinite(c.error) ? fmt::format("{} ± {:.2f}", mean, c.error) : mean;
}

/// -1, 0 or 1: does `a` lie below, at or above `b`, as far as their errors tell?
int compared(const Correlation& a, const Correlation& b) {
    const double error = std::hypot(a.error, b.error);
    if (!std::isfinite(error) || std::abs(a.mean - b.mean) <= kErrors * error) return 0;
    return a.mean < b.mean ? -1 : 1;
}

std::string within_label(const std::string& recording) {
    return "within " + recording;
}
std::string cross_label(const SusceptibilityAnalysis::Cross& c) {
    return c.first + " with " + c.second;
}

std::string cross_sentence(const SusceptibilityAnalysis& analysis,
                           const SusceptibilityAnalysis::Cross& cross) {
    std::string text = fmt::format(
        "Between {} and {} the maps of two windows agree by r = {} on "
        "the metal ({} over all pixels)",
        cross.first, cross.second, printed(cross.windows.specimen), printed(cross.windows.all));
    int less = 0, both = 0;
    for (const auto& w : analysis.within) {
        if (w.recording != cross.first && w.recording != cross.second) continue;
        ++both;
        less += compared(cross.windows.specimen, w.windows.specimen) < 0;
    }
    if (less == both) return text + ": less than within either.";
    return text + (less == 0 ? ", which two standard errors do not tell from within them."
                             : ": less than within one of them, and not told from the other.");
}

void add(Image<SrgbU8>& sheet, const Image<float>& map, int left, int top) {
    const auto [low, high] = std::ranges::minmax(map.pixels());
    const float range = high > low ? high - low : 1;
    for (int y = 0; y < map.height() * kEnlarged; ++y) {
        for (int x = 0; x < map.width() * kEnlarged; ++x) {
            const float v = (map(x / kEnlarged, y / kEnlarged) - low) / range;
            const auto gray = std::uint8_t(std::lround(255 * v));
            sheet(left + x, top + y) = {gray, gray, gray};
        }
    }
}

Json json_of(const AreaCorrelations& a) {
    const auto one = [](const Correlation& c) {
        return Json{{"r", c.mean},
                    {"standard_error", std::isfinite(c.error) ? Json(c.error) : Json(nullptr)},
                    {"count", c.count}};
    };
    return {{"all", one(a.all)}, {"specimen", one(a.specimen)}};
}

}  // namespace

std::vector<std::string> susceptibility_sentences(const SusceptibilityAnalysis& analysis) {
    std::vector<std::string> list;
    for (const auto& w : analysis.within) {
        list.push_back(
            fmt::format("Within {} the maps of two windows agree by r = {} on the "
                        "metal ({} over all pixels).",
                        w.recording, printed(w.windows.specimen), printed(w.windows.all)));
    }
    for (const auto& c : analysis.cross) list.push_back(cross_sentence(analysis, c));
    for (std::size_t i = 0; i < analysis.within.size(); ++i) {
        const auto& w = analysis.within[i];
        list.push_back(
            fmt::format("With what really changed on {}, {}, the mean map agrees by "
                        "r = {} on the metal ({} over all pixels).",
                        w.recording,
                        analysis.recordings[i].source ? "which the network learned from"
                                                      : "which it has never seen",
                        printed(w.change.specimen), printed(w.change.all)));
    }
    return list;
}

Table susceptibility_table(const SusceptibilityAnalysis& analysis) {
    Table table;
    table.id = "susceptibility";
    table.title = "Agreement of the maps";
    table.caption =
        "Mean Pearson's r of the susceptibility maps of two windows, same pixels, with "
        "one jackknife standard error; windows share no sample.";
    table.columns = {{"pair", "windows of", Align::left},
                     {"pairs", "pairs", Align::right, {NumberStyle::integer, 0, false}},
                     {"r_specimen", "r, on the metal", Align::right, kR, true},
                     {"r_all", "r, all pixels", Align::right, kR, true}};
    for (const auto& w : analysis.within) {
        table.add_row({within_label(w.recording), w.windows.all.count, cell(w.windows.specimen),
                       cell(w.windows.all)});
    }
    for (const auto& c : analysis.cross) {
        table.add_row(
            {cross_label(c), c.windows.all.count, cell(c.windows.specimen), cell(c.windows.all)});
    }
    return table;
}

Table susceptibility_change_table(const SusceptibilityAnalysis& analysis) {
    Table table;
    table.id = "susceptibility_change";
    table.title = "Agreement with what changed";
    table.caption =
        "Pearson's r of a recording's mean map with the change between its ends (mean "
        "over channels of the difference of the medians of 20 samples), with one "
        "jackknife standard error over windows.";
    table.columns = {{"recording", "recording", Align::left},
                     {"learned", "learned from", Align::left},
                     {"r_specimen", "r, on the metal", Align::right, kR, true},
                     {"r_all", "r, all pixels", Align::right, kR, true}};
    for (std::size_t i = 0; i < analysis.within.size(); ++i) {
        const auto& w = analysis.within[i];
        table.add_row({w.recording, analysis.recordings[i].source ? "yes" : "no",
                       cell(w.change.specimen), cell(w.change.all)});
    }
    return table;
}

Figure susceptibility_figure(const SusceptibilityAnalysis& analysis) {
    Figure figure;
    figure.id = "transfer";
    figure.title = "Does the susceptibility transfer?";
    figure.caption =
        "Pearson's r; bars are one jackknife standard error. Left: maps of two "
        "windows. Right: the mean map with what really changed.";
    FigurePanel pairs, change;
    pairs.title = "maps of two windows";
    change.title = "with what changed";
    pairs.y = change.y = {.label = "Pearson's r", .lo = -1.0, .hi = 1.0, .format = kR};
    FigureSeries metal{"on the metal", SeriesKind::points, {}},
        all{"all pixels", SeriesKind::points, {}};
    FigureSeries metal_change = metal, all_change = all;
    const auto add_pair = [&](const std::string& label, const AreaCorrelations& a) {
        const double x = double(pairs.x.categories.size());
        pairs.x.categories.push_back(label);
        metal.points.push_back(point(x, a.specimen));
        all.points.push_back(point(x, a.all));
    };
    for (const auto& w : analysis.within) {
        add_pair(within_label(w.recording), w.windows);
        const double x = double(change.x.categories.size());
        change.x.categories.push_back(w.recording);
        metal_change.points.push_back(point(x, w.change.specimen));
        all_change.points.push_back(point(x, w.change.all));
    }
    for (const auto& c : analysis.cross) add_pair(cross_label(c), c.windows);
    pairs.series = {metal, all};
    change.series = {metal_change, all_change};
    figure.panels = {pairs, change};
    return figure;
}

Report susceptibility_report(const Checkpoint& checkpoint, const SusceptibilityAnalysis& analysis) {
    Report report;
    report.title = "What a network believes of a surface";
    report.subtitle = fmt::format("patinanet, trained on {}; susceptibility maps of {} recordings",
                                  checkpoint.facts.source_names(), analysis.recordings.size());
    report.sections.push_back(
        {"verdict", "Verdict", {BulletList{susceptibility_sentences(analysis)}}});
    report.sections.push_back({"maps",
                               "Agreement of the maps",
                               {susceptibility_figure(analysis), susceptibility_table(analysis)}});
    report.sections.push_back(
        {"change", "Agreement with what changed", {susceptibility_change_table(analysis)}});
    report.sections.push_back(
        {"method",
         "How it was done",
         {Paragraph{"The network is shown the first frames of windows that share no sample, and "
                    "its static susceptibility is read before any step is made. Contrast between "
                    "metal and backdrop makes a high correlation by itself, so the numbers on the "
                    "metal are the ones to read; across recordings it is where both show metal. "
                    "Pixels are compared where they are: specimens are not aligned. A correlation "
                    "of maps says how alike two maps are, not that either is right. The maps are "
                    "in maps.png: a row per recording, its mean map, then what changed."}}});
    return report;
}

Image<SrgbU8> susceptibility_sheet(const SusceptibilityAnalysis& analysis) {
    const int size = kEnlarged * analysis.recordings.front().mean.width();
    const int rows = int(analysis.recordings.size());
    Image<SrgbU8> sheet(2 * size + 3 * kGap, rows * (size + kGap) + kGap);
    for (SrgbU8& p : sheet.pixels()) p = {32, 32, 32};
    for (int i = 0; i < rows; ++i) {
        const SusceptibilityMaps& maps = analysis.recordings[std::size_t(i)];
        const int top = kGap + i * (size + kGap);
        add(sheet, maps.mean, kGap, top);
        add(sheet, maps.change, 2 * kGap + size, top);
    }
    return sheet;
}

Json json_of(const SusceptibilityAnalysis& analysis) {
    Json within = Json::array(), cross = Json::array();
    for (std::size_t i = 0; i < analysis.within.size(); ++i) {
        const auto& w = analysis.within[i];
        within.push_back({{"recording", w.recording},
                          {"learned_from", analysis.recordings[i].source},
                          {"windows", json_of(w.windows)},
                          {"change", json_of(w.change)}});
    }
    for (const auto& c : analysis.cross)
        cross.push_back(
            {{"first", c.first}, {"second", c.second}, {"windows", json_of(c.windows)}});
    return {{"within", std::move(within)},
            {"cross", std::move(cross)},
            {"sentences", susceptibility_sentences(analysis)}};
}

}  // namespace verdigris
