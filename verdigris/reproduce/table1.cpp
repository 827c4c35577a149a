// SPDX-License-Identifier: MIT
// Table 1, and the intervals that Section 6 gives in its text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/reproduce/compare.h"
#include "verdigris/reproduce/ours.h"
#include "verdigris/reproduce/paper_values.h"
#include "verdigris/reproduce/sections.h"
#include "verdigris/results/cells.h"

namespace verdigris {
namespace {

const double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<const char*, 3> kHorizonIds{"t1", "t5", "tK"};

const OursForecaster* ours_of(const std::string& name, int direction,
                              const std::map<std::string, OursEvaluation>& all) {
    for (const auto& [id, evaluation] : all)
        if (const auto* f = evaluation[std::size_t(direction)].find(name)) return f;
    return nullptr;
}

/// At +1, +5 and the last horizon.
double at_horizon(const std::vector<double>& values, std::size_t which) {
    if (values.empty()) return kNone;
    if (which == 2) return values.back();
    return which == 1 ? (values.size() >= 5 ? values[4] : kNone) : values[0];
}

std::vector<std::string> printed_rows() {
    std::vector<std::string> rows{"persistence", "affinergb"};
    rows.insert(rows.end(), paper_networks().begin(), paper_networks().end());
    return rows;
}

TableRow gain_row(const std::string& name, int direction, const OursForecaster* ours) {
    TableRow row{TableCell(name), paper_cell(paper_value("table1", direction, name, "mean")),
                 ours ? finite_or_missing(ours->mean) : TableCell()};
    if (name == "persistence") {
        row.push_back(not_printed());
        row.push_back(not_printed());
    } else {
        row.push_back(paper_cell(paper_share("table1", direction, name, "gain")));
        row.push_back(ours && ours->gain ? cell_of(*ours->gain) : TableCell());
    }
    return row;
}

TableRow horizon_row(const std::string& name, int direction, const OursForecaster* ours) {
    TableRow row{TableCell(name)};
    for (std::size_t h = 0; h < kHorizonIds.size(); ++h) {
        row.push_back(paper_cell(paper_value("table1", direction, name, kHorizonIds[h])));
        row.push_back(ours ? finite_or_missing(at_horizon(ours->errors, h)) : TableCell());
    }
    return row;
}

template <class RowOf>
void add_groups(const Reproduced& r, const std::map<std::string, OursEvaluation>& all,
                const RowOf& row_of, Table& table) {
    for (const int d : {kChamberToAir, kAirToChamber}) {
        RowGroup group;
        group.title =
            fmt::format("{}; ours {}", d == kChamberToAir ? "chamber -> air" : "air -> chamber",
                        r.direction(d));
        std::vector<std::string> names = printed_rows();
        for (const auto& [id, evaluation] : all)
            for (const OursForecaster& f : evaluation[std::size_t(d)].forecasters)
                if (std::ranges::count(names, f.name) == 0) names.push_back(f.name);
        for (const std::string& name : names)
            group.rows.push_back(row_of(name, d, ours_of(name, d, all)));
        table.groups.push_back(std::move(group));
    }
    table.note = "–: the paper prints none. n/a: not made here; the reason stands above.";
    table.group_header = "direction";
}

/// Two tables: a page is not wide enough for all of it beside each other.
Table gains_table(const Reproduced& r, const std::map<std::string, OursEvaluation>& all) {
    Table table;
    table.id = "table1";
    table.title = "Table 1: a specimen never seen";
    table.caption =
        "Foreground MSE, the mean over the horizons, and its gain over holding still: the paper's "
        "printed values, ours beside them. Intervals of ours: nominal 95 %, of non-overlapping "
        "blocks, where there are five or more; they cover less than they say (docs/PROTOCOL.md)." +
        r.caution();
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"mean_paper", "mean, paper", Align::right, kError},
                     {"mean_ours", "mean, ours", Align::right, kError},
                     {"gain_paper", "gain, paper", Align::right, kGain},
                     {"gain_ours", "gain, ours", Align::right, kGain, true}};
    add_groups(r, all, gain_row, table);
    return table;
}

Table horizons_table(const Reproduced& r, const std::map<std::string, OursEvaluation>& all) {
    Table table;
    table.id = "table1-horizons";
    table.title = "Table 1: by horizon";
    table.caption = "Foreground MSE at t+1, t+5 and t+K." + r.caution();
    table.columns = {{"forecaster", "Forecaster", Align::left}};
    for (const auto& [id, head] :
         {std::pair("t1", "t+1"), std::pair("t5", "t+5"), std::pair("tK", "t+K")}) {
        table.columns.push_back(
            {fmt::format("{}_paper", id), fmt::format("{}, paper", head), Align::right, kError});
        table.columns.push_back(
            {fmt::format("{}_ours", id), fmt::format("{}, ours", head), Align::right, kError});
    }
    add_groups(r, all, horizon_row, table);
    return table;
}

Table intervals_table(const Reproduced& r, const std::map<std::string, OursEvaluation>& all) {
    Table table;
    table.id = "intervals";
    table.title = "Section 6: how much the windows resolve";
    table.caption =
        "Gain of affinergb over holding still, with its nominal 95 % interval by bootstrap: over "
        "windows one by one (naive, too narrow because they overlap), and over whole blocks." +
        r.caution();
    table.group_header = "direction";
    table.columns = {{"bootstrap", "Bootstrap", Align::left},
                     {"paper", "paper", Align::right, kGain, true},
                     {"ours", "ours", Align::right, kGain, true}};
    for (const int d : {kChamberToAir, kAirToChamber}) {
        RowGroup group{d == kChamberToAir ? "chamber -> air" : "air -> chamber", {}};
        const OursForecaster* ours = ours_of("affinergb", d, all);
        const double gain = *paper_share("table1", d, "affinergb", "gain");
        for (const std::string kind : {"naive", "block"}) {
            const auto low = paper_share("intervals", d, "affinergb", kind + "_low"),
                       high = paper_share("intervals", d, "affinergb", kind + "_high");
            TableCell mine;
            if (ours && ours->gain)
                mine = kind == "block" ? cell_of(*ours->gain)
                                       : interval_cell(ours->gain->value, ours->naive);
            group.rows.push_back({TableCell(kind), TableCell(gain, {*low, *high}), mine});
        }
        table.groups.push_back(std::move(group));
    }
    return table;
}

BulletList sentences(const Reproduced& r, const std::map<std::string, OursEvaluation>& all) {
    BulletList list;
    for (const int d : {kChamberToAir, kAirToChamber}) {
        const std::string where = d == kChamberToAir ? "chamber -> air" : "air -> chamber";
        std::vector<NamedGain> paper, ours;
        for (const std::string& name : printed_rows()) {
            if (name == "persistence") continue;
            const double printed = *paper_share("table1", d, name, "gain");
            paper.push_back({name, printed});
            const OursForecaster* f = ours_of(name, d, all);
            if (!f || !f->gain) continue;
            ours.push_back({name, f->gain->value, sign_is_settled(*f->gain)});
            list.items.push_back(compare_gain(where + ", " + name, printed, *f->gain));
        }
        list.items.push_back(compare_winners(where, paper, ours));
        const OursForecaster* still = ours_of("persistence", d, all);
        if (still)
            list.items.push_back(
                compare_error(where + ", holding still (how fast the specimen moves)",
                              *paper_value("table1", d, "persistence", "mean"), still->mean));
    }
    if (!r.options.quick && all.size() > 1)
        list.items.push_back(
            "Each network is one training with one seed, here as in the paper: no "
            "interval says how another seed would do.");
    return list;
}

}  // namespace

ReportSection table1_section(const Reproduced& r) {
    ReportSection section{"section-table1", "Table 1: generalization to an unseen specimen", {}};
    std::vector<std::string> problems, ids{"evaluate"};
    for (const std::string& network : paper_networks()) {
        if (r.task("evaluate-" + network))
            ids.push_back("evaluate-" + network);
        else
            problems.push_back(network + ": n/a, --quick trains " +
                               in_a_row(trained_networks(r.options)) + " only.");
    }
    std::map<std::string, OursEvaluation> all;
    for (const std::string& id : ids)
        if (const auto evaluation = ours_or_reason(r, id, read_ours_evaluation, problems))
            all[id] = *evaluation;
    section.blocks.push_back(sentences(r, all));
    add_problems(problems, section);
    section.blocks.push_back(gains_table(r, all));
    section.blocks.push_back(horizons_table(r, all));
    section.blocks.push_back(intervals_table(r, all));
    add_commands(r, ids, section);
    return section;
}

ReportSection figure3_section(const Reproduced& r) {
    ReportSection section{"section-figure3", "Figure 3: error against horizon", {}};
    std::vector<std::string> problems, ids{"evaluate"};
    for (const std::string& network : trained_networks(r.options))
        ids.push_back("evaluate-" + network);
    std::map<std::string, OursEvaluation> all;
    for (const std::string& id : ids)
        if (const auto evaluation = ours_or_reason(r, id, read_ours_evaluation, problems))
            all[id] = *evaluation;
    Figure figure;
    figure.id = "figure3";
    figure.title = "Figure 3: foreground MSE by horizon";
    figure.caption =
        "Lines: ours. Points: the paper's printed values at t+1, t+5 and t+K (its curves are "
        "printed as a drawing only)." +
        r.caution();
    for (const int d : {kChamberToAir, kAirToChamber}) {
        FigurePanel panel;
        panel.title = d == kChamberToAir ? "chamber -> air" : "air -> chamber";
        panel.x = {.label = "horizon, units"};
        panel.y = {.label = "foreground MSE", .scale = AxisScale::log10, .format = kError};
        for (const std::string& name : printed_rows()) {
            if (const OursForecaster* f = ours_of(name, d, all)) {
                FigureSeries line{name, SeriesKind::line, {}, name == "persistence"};
                for (std::size_t k = 0; k < f->errors.size(); ++k)
                    if (f->errors[k] > 0) line.points.push_back({double(k + 1), f->errors[k]});
                if (!line.points.empty()) panel.series.push_back(std::move(line));
            }
            // Two of six are enough to see how far apart the recordings are.
            if (name != "persistence" && name != "affinergb") continue;
            FigureSeries points{name + ", paper", SeriesKind::points, {}, name == "persistence"};
            for (std::size_t h = 0; h < 3; ++h)
                points.points.push_back({h == 0   ? 1.0
                                         : h == 1 ? 5.0
                                                  : 10.0,
                                         *paper_value("table1", d, name, kHorizonIds[h])});
            panel.series.push_back(std::move(points));
        }
        figure.panels.push_back(std::move(panel));
    }
    BulletList list;
    for (const int d : {kChamberToAir, kAirToChamber}) {
        const OursForecaster* f = ours_of("affinergb", d, all);
        if (!f || f->gains.empty()) continue;
        std::array<double, 3> paper{}, ours{};
        for (std::size_t h = 0; h < 3; ++h) {
            paper[h] = *paper_share("figure3", d, "affinergb", kHorizonIds[h]);
            ours[h] = at_horizon(f->gains, h);
        }
        const auto grows = [](const std::array<double, 3>& g) {
            return g[0] < g[1] && g[1] < g[2]   ? "grows with the horizon"
                   : g[0] > g[1] && g[1] > g[2] ? "falls with the horizon"
                                                : "neither grows nor falls throughout";
        };
        list.items.push_back(fmt::format(
            "{}, affinergb at t+1, t+5, t+K: {}, {}, {} in the paper, which {}; {}, {}, {} here, "
            "which {}. No interval is given per horizon, by either.",
            d == kChamberToAir ? "chamber -> air" : "air -> chamber", signed_percent(paper[0]),
            signed_percent(paper[1]), signed_percent(paper[2]), grows(paper),
            signed_percent(ours[0]), signed_percent(ours[1]), signed_percent(ours[2]),
            grows(ours)));
    }
    section.blocks.push_back(std::move(list));
    add_problems(problems, section);
    section.blocks.push_back(std::move(figure));
    add_commands(r, ids, section);
    return section;
}

}  // namespace verdigris
