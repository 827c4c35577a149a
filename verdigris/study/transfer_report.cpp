// SPDX-License-Identifier: MIT
#include "verdigris/study/transfer_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;
constexpr NumberFormat kGain{NumberStyle::percent, 1, true};
constexpr NumberFormat kError{NumberStyle::scientific, 2, false};
constexpr NumberFormat kFactor{NumberStyle::fixed, 2, false};
constexpr NumberFormat kCount{NumberStyle::integer, 0, false};

/// What the tables and the figure show of the sixteen states; every one is among the scores.
struct Cell {
    TransferChange change;
    const char* words;
};
constexpr Cell kCells[] = {
    {{}, "another day"},
    {{.pattern = true}, "another pattern"},
    {{.pose = true}, "another pose"},
    {{.pattern = true, .pose = true}, "pattern and pose"},
    {{.camera = true}, "another camera"},
    {{.kinetics = true}, "other kinetics"},
    {{.camera = true, .kinetics = true}, "another place"},
    {{.pattern = true, .pose = true, .camera = true, .kinetics = true}, "all of it"}};
constexpr const char* kFactors[kTransferFactors] = {"another pattern", "another pose",
                                                    "another camera", "other kinetics"};
constexpr const char* kFactorIds[kTransferFactors] = {"pattern", "pose", "camera", "kinetics"};

TableCell cell(const SeedMean& m) {
    return m.has_interval() ? TableCell(m.mean, {m.low, m.high}) : TableCell(m.mean);
}
/// A mean of logarithms as the factor that it is.
TableCell factor_cell(const SeedMean& m) {
    if (!m.has_interval()) return TableCell(std::exp(m.mean));
    return TableCell(std::exp(m.mean), {std::exp(m.low), std::exp(m.high)});
}
FigurePoint point(double x, const SeedMean& m) {
    FigurePoint p{x, m.mean};
    if (m.has_interval()) p.bounds = Bounds{m.low, m.high};
    return p;
}

/// Gains of one forecaster in one cell, mean over seeds.
SeedMean cell_gain(const TransferStudy& study, const std::string& preset,
                   const std::string& forecaster, const Cell& which) {
    std::vector<double> gains;
    for (const TransferCell& c : study.cells) {
        if (c.preset != preset || !(c.change == which.change)) continue;
        for (const TransferScore& s : c.scores)
            if (s.forecaster == forecaster) gains.push_back(s.gain());
    }
    return seed_mean(gains);
}

SeedMean count_gain(const TransferStudy& study, const std::string& preset,
                    const std::string& forecaster, int specimens) {
    std::vector<double> gains;
    for (const SpecimenCountCell& c : study.counts) {
        if (c.preset != preset || c.specimens != specimens) continue;
        for (const TransferScore& s : c.scores)
            if (s.forecaster == forecaster) gains.push_back(s.gain());
    }
    return seed_mean(gains);
}

std::vector<std::string> forecasters(const TransferStudy& study) {
    std::vector<std::string> names;
    for (const TransferScore& s : study.cells.front().scores) names.push_back(s.forecaster);
    return names;
}

/// A row of a table, a place on an axis: gains of every preset and forecaster in one situation.
struct GainRow {
    std::string words;
    std::function<SeedMean(const std::string& preset, const std::string& forecaster)> gain;
};

std::vector<GainRow> cell_rows(const TransferStudy& study) {
    std::vector<GainRow> rows;
    for (const Cell& c : kCells) {
        rows.push_back({c.words, [&study, c](const std::string& preset, const std::string& name) {
                            return cell_gain(study, preset, name, c);
                        }});
    }
    return rows;
}

std::vector<GainRow> count_rows(const TransferStudy& study) {
    std::vector<GainRow> rows;
    for (const int n : study.options.specimens) {
        rows.push_back({n == 1 ? "1 specimen" : fmt::format("{} specimens", n),
                        [&study, n](const std::string& preset, const std::string& name) {
                            return count_gain(study, preset, name, n);
                        }});
    }
    return rows;
}

/// A column per forecaster, a group per preset.
void add_gains(const TransferStudy& study, const std::vector<GainRow>& rows, Table& table) {
    for (const std::string& name : forecasters(study))
        table.columns.push_back({name, name, Align::right, kGain, true});
    table.group_header = "preset";
    for (const std::string& preset : study.options.presets) {
        RowGroup group{preset, {}};
        for (const GainRow& r : rows) {
            TableRow row{r.words};
            for (const std::string& name : forecasters(study))
                row.push_back(cell(r.gain(preset, name)));
            group.rows.push_back(std::move(row));
        }
        table.groups.push_back(std::move(group));
    }
}

/// A panel per preset, a series per forecaster.
std::vector<FigurePanel> gain_panels(const TransferStudy& study, const std::vector<GainRow>& rows,
                                     const std::string& x_label) {
    std::vector<FigurePanel> panels;
    for (const std::string& preset : study.options.presets) {
        FigurePanel panel;
        panel.title = preset;
        panel.x.label = x_label;
        panel.y = {.label = "gain over persistence", .format = kGain};
        for (const GainRow& r : rows) panel.x.categories.push_back(r.words);
        for (const std::string& name : forecasters(study)) {
            FigureSeries series{name, SeriesKind::points, {}};
            for (std::size_t i = 0; i < rows.size(); ++i)
                series.points.push_back(point(double(i), rows[i].gain(preset, name)));
            panel.series.push_back(std::move(series));
        }
        panel.references.push_back({"persistence", 0});
        panels.push_back(std::move(panel));
    }
    return panels;
}

std::string seeds_words(int count) {
    return count == 1 ? "1 seed" : fmt::format("{} seeds", count);
}

/// "another pose: 1.40 times the error, 1.10 to 1.80", or that it cannot be told from none.
std::string effect_words(const char* what, const SeedMean& m) {
    if (!m.has_interval())
        return fmt::format("{}: {:.2f} times the error (one seed)", what, std::exp(m.mean));
    const std::string range = fmt::format("{:.2f} times the error, {:.2f} to {:.2f}",
                                          std::exp(m.mean), std::exp(m.low), std::exp(m.high));
    const bool told = m.low > 0 || m.high < 0;
    return fmt::format("{}: {}{}", what, range, told ? "" : ", not told from none");
}

}  // namespace

std::vector<std::string> transfer_sentences(const TransferStudy& study) {
    std::vector<std::string> list;
    for (const TransferEffects& e : transfer_effects(study)) {
        if (e.forecaster == "affinergb") continue;  // it learns nothing beforehand
        const SeedMean day = cell_gain(study, e.preset, e.forecaster, kCells[0]);
        std::string gain = number_text(day.mean, kGain);
        if (day.has_interval()) {
            gain += fmt::format(" ({} to {})", number_text(day.low, kGain),
                                number_text(day.high, kGain));
        }
        std::vector<std::string> costs;
        for (int f = 0; f < kTransferFactors; ++f)
            costs.push_back(effect_words(kFactors[f], e.of[f]));
        list.push_back(fmt::format(
            "{} on {}, {}: against holding still it gains {} on another day of the specimen "
            "it learned from. Changing one thing: {}.",
            e.forecaster, e.preset, seeds_words(day.count), gain, fmt::join(costs, "; ")));
    }
    return list;
}

Table transfer_effect_table(const TransferStudy& study) {
    Table table;
    table.id = "effects";
    table.title = "What changing one thing costs";
    table.caption =
        "Factors on the error relative to holding still, geometric means over seeds and over the "
        "states of what else may change, with 95 % intervals (Student's t on logarithms, paired "
        "by seed); above 1 is worse. The last two: the factor of changing both beyond the product "
        "of the two. affinergb learns nothing beforehand: its factors are what the recordings "
        "themselves do. Simulated specimens.";
    table.columns = {{"preset", "preset", Align::left}, {"forecaster", "forecaster", Align::left}};
    for (int f = 0; f < kTransferFactors; ++f)
        table.columns.push_back({kFactorIds[f], kFactors[f], Align::right, kFactor, true});
    table.columns.push_back({"pattern_and_pose", "pattern and pose", Align::right, kFactor, true});
    table.columns.push_back(
        {"camera_and_kinetics", "camera and kinetics", Align::right, kFactor, true});
    for (const TransferEffects& e : transfer_effects(study)) {
        TableRow row{e.preset, e.forecaster};
        for (const SeedMean& m : e.of) row.push_back(factor_cell(m));
        row.push_back(factor_cell(e.pattern_and_pose));
        row.push_back(factor_cell(e.camera_and_kinetics));
        table.add_row(std::move(row));
    }
    return table;
}

Table transfer_cell_table(const TransferStudy& study) {
    Table table;
    table.id = "cells";
    table.title = "Gains over holding still";
    table.caption =
        "Of forecasters on a recording that differs from the one learned from in what "
        "the column says; mean over seeds with 95 % intervals of Student's t.";
    table.columns = {{"differs", "judged on", Align::left}};
    add_gains(study, cell_rows(study), table);
    return table;
}

Table specimen_count_table(const TransferStudy& study) {
    Table table;
    table.id = "specimens";
    table.title = "Learning from more specimens";
    table.caption =
        "Gain over holding still on a specimen of another pattern and pose, after as "
        "many steps of training, on windows of 1 or more specimens; mean over seeds "
        "with 95 % intervals of Student's t.";
    table.columns = {{"specimens", "learned from", Align::left}};
    add_gains(study, count_rows(study), table);
    return table;
}

Table transfer_scores(const TransferStudy& study) {
    Table table;
    table.id = "scores_all";
    table.title = "Every score";
    table.columns = {{"part", "part", Align::left},
                     {"preset", "preset", Align::left},
                     {"seed", "seed", Align::right, kCount},
                     {"specimens", "specimens", Align::right, kCount},
                     {"pattern", "pattern", Align::left},
                     {"pose", "pose", Align::left},
                     {"camera", "camera", Align::left},
                     {"kinetics", "kinetics", Align::left},
                     {"forecaster", "forecaster", Align::left},
                     {"error", "error", Align::right, kError},
                     {"persistence", "persistence", Align::right, kError}};
    const auto add = [&table](const char* part, const std::string& preset, int seed, int specimens,
                              const TransferChange& c, const TransferScore& s) {
        const auto word = [](bool changed) { return changed ? "other" : "same"; };
        table.add_row({part, preset, seed, specimens, word(c.pattern), word(c.pose), word(c.camera),
                       word(c.kinetics), s.forecaster, s.error, s.persistence});
    };
    for (const TransferCell& c : study.cells) {
        for (const TransferScore& s : c.scores) add("factorial", c.preset, c.seed, 1, c.change, s);
    }
    for (const SpecimenCountCell& c : study.counts) {
        for (const TransferScore& s : c.scores)
            add("specimens", c.preset, c.seed, c.specimens, {.pattern = true, .pose = true}, s);
    }
    for (const TransferStudy::Own& o : study.own)
        add("validation", o.preset, o.seed, 1, {}, {o.network, o.error, o.persistence});
    return table;
}

Figure transfer_figure(const TransferStudy& study) {
    Figure figure;
    figure.id = "factorial";
    figure.title = "One thing changed at a time";
    figure.caption = "Gain over holding still, mean over seeds with 95 % intervals of Student's t.";
    figure.panels = gain_panels(study, cell_rows(study), "");
    return figure;
}

Figure specimen_count_figure(const TransferStudy& study) {
    Figure figure;
    figure.id = "more-specimens";
    figure.title = "More specimens";
    figure.caption =
        "Gain over holding still on a specimen never seen, by how many were learned "
        "from, for as many steps; mean over seeds with 95 % intervals.";
    figure.panels = gain_panels(study, count_rows(study), "learned from");
    return figure;
}

Report transfer_report(const TransferStudy& study) {
    const TransferStudyOptions& o = study.options;
    std::vector<std::string> places;
    for (const std::string& p : o.presets)
        places.push_back(fmt::format("for {} that of {}", p, other_place(p)));
    Report report;
    report.title = "Why does a network not transfer?";
    report.subtitle = fmt::format("{} simulated specimens per place, {} pixels, {} epochs", o.seeds,
                                  o.size, o.epochs);
    ReportSection verdict{"verdict", "Verdict", {BulletList{transfer_sentences(study)}}};
    if (o.seeds < 3) {
        verdict.blocks.push_back(
            Status{"few_seeds", Severity::caution,
                   fmt::format("With {} an interval says next to nothing; take three at the least.",
                               seeds_words(o.seeds))});
    }
    report.sections.push_back(std::move(verdict));
    report.sections.push_back(
        {"factorial-design",
         "One thing changed at a time",
         {transfer_figure(study), transfer_effect_table(study), transfer_cell_table(study)}});
    report.sections.push_back(
        {"count", "More specimens", {specimen_count_figure(study), specimen_count_table(study)}});
    report.sections.push_back(
        {"method",
         "How it was done",
         {Paragraph{fmt::format(
             "All specimens are simulated. A network learns from one specimen ({} windows of the "
             "first half of 950 samples, {} epochs, the epoch chosen on a later stretch of the "
             "same "
             "recording) and is judged on {} windows of each of sixteen other recordings. In all "
             "of them the day is another (noise, the wandering of light and environment); beside "
             "it four things are the same or others, in every combination: the pattern (another "
             "piece of metal), the pose (turned by 8 degrees, moved by 5 % of the frame, a tenth "
             "smaller), the camera with its lamp, and the kinetics (how the film starts and grows, "
             "the pace of the environment), the last two those of the other place: {}. Frames are "
             "not cropped, so that a pose is a pose. "
             "In the second part windows of several specimens are mixed and the number of steps is "
             "kept.",
             o.train_windows > 0 ? std::to_string(o.train_windows) : "all", o.epochs,
             o.test_windows, fmt::join(places, "; "))}}});
    return report;
}

Json json_of(const TransferStudy& study) {
    const auto mean = [](const SeedMean& m) {
        return Json{{"mean", m.mean},
                    {"low", m.has_interval() ? Json(m.low) : Json(nullptr)},
                    {"high", m.has_interval() ? Json(m.high) : Json(nullptr)},
                    {"seeds", m.count}};
    };
    Json effects = Json::array();
    for (const TransferEffects& e : transfer_effects(study)) {
        Json j{{"preset", e.preset}, {"forecaster", e.forecaster}};
        for (int f = 0; f < kTransferFactors; ++f)
            j[fmt::format("log_{}", kFactorIds[f])] = mean(e.of[f]);
        j["log_pattern_and_pose"] = mean(e.pattern_and_pose);
        j["log_camera_and_kinetics"] = mean(e.camera_and_kinetics);
        j["log_ratio_same_specimen"] = mean(e.day_only);
        effects.push_back(std::move(j));
    }
    return {{"simulated", true},
            {"seeds", study.options.seeds},
            {"size", study.options.size},
            {"epochs", study.options.epochs},
            {"effects", std::move(effects)},
            {"sentences", transfer_sentences(study)}};
}

}  // namespace verdigris
