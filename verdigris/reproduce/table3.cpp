// SPDX-License-Identifier: MIT
// Table 3: how the rendered materials look.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/reproduce/compare.h"
#include "verdigris/reproduce/ours.h"
#include "verdigris/reproduce/paper_values.h"
#include "verdigris/reproduce/sections.h"
#include "verdigris/results/cells.h"

namespace verdigris {
namespace {

constexpr NumberFormat kDistance{NumberStyle::fixed, 3, false};
constexpr int kHorizons[] = {5, 10, 20, 50};

const OursMaterial* find(const OursMaterials& ours, int d, const std::string& name) {
    for (const OursMaterial& m : ours.forecasters[std::size_t(d)])
        if (m.name == name) return &m;
    return nullptr;
}

double value_at(const std::map<int, double>& values, int horizon) {
    const auto found = values.find(horizon);
    return found == values.end() ? std::nan("") : found->second;
}

void add_row(RowGroup& group, const std::string& what, const std::string& title,
             const std::string& paper_row, const OursMaterial* ours) {
    TableRow row{TableCell(title)};
    for (const int h : kHorizons) {
        row.push_back(paper_row.empty() ? not_printed()
                                        : paper_cell(paper_value("table3", kNoDirection, paper_row,
                                                                 fmt::format("{}{}", what, h))));
        row.push_back(
            ours ? finite_or_missing(value_at(what == "flip" ? ours->flip : ours->lpips, h))
                 : TableCell());
    }
    group.rows.push_back(std::move(row));
}

/// `what`: "flip" or "lpips".
Table distances(const Reproduced& r, const OursMaterials* ours, const std::string& what) {
    const std::string head = what == "flip" ? "FLIP" : "LPIPS";
    Table table;
    table.id = what == "flip" ? "table3" : "table3-lpips";
    table.title = "Table 3: rendered materials, " + head;
    table.caption =
        head +
        " between pictures of the forecast's material and of the true future "
        "frame's, lower is closer. The paper does not say of which direction its table is; ours "
        "are both. Geometry, light and field of view are not the paper's, which it does not "
        "print." +
        r.caution();
    table.note = ours && !ours->no_lpips.empty() ? "LPIPS: n/a here, " + ours->no_lpips + "."
                                                 : "n/a: not made here.";
    table.group_header = "direction of ours";
    table.columns = {{"source", "Texture source", Align::left}};
    for (const int h : kHorizons) {
        table.columns.push_back({fmt::format("{}{}_paper", what, h), fmt::format("+{}, paper", h),
                                 Align::right, kDistance});
        table.columns.push_back(
            {fmt::format("{}{}_ours", what, h), "ours", Align::right, kDistance});
    }
    for (const int d : {kChamberToAir, kAirToChamber}) {
        RowGroup group{r.direction(d), {}};
        const auto of = [&](const std::string& name) {
            return ours ? find(*ours, d, name) : nullptr;
        };
        add_row(group, what, "affinergb", "affinergb", of("affinergb"));
        add_row(group, what, "patinanet", "patinanet", of("patinanet"));
        add_row(group, what, "static control (last frame held)", "control",
                ours ? of(ours->control) : nullptr);
        if (ours)
            for (const OursMaterial& m : ours->forecasters[std::size_t(d)])
                if (m.name != "affinergb" && m.name != "patinanet" && m.name != ours->control)
                    add_row(group, what, m.name, "", &m);
        table.groups.push_back(std::move(group));
    }
    return table;
}

BulletList sentences(const Reproduced& r, const OursMaterials& ours) {
    BulletList list;
    for (const int d : {kChamberToAir, kAirToChamber}) {
        for (const std::string name : {"affinergb", "patinanet"}) {
            const OursMaterial* m = find(ours, d, name);
            if (!m) continue;
            for (const int h : kHorizons) {
                const auto gain = m->gain.find(h);
                if (gain == m->gain.end()) continue;
                const std::string column = fmt::format("flip{}", h);
                const double paper =
                    1 - *paper_value("table3", kNoDirection, name, column) /
                            *paper_value("table3", kNoDirection, "control", column);
                list.items.push_back(
                    compare_gain(fmt::format("{}, {} at t+{}, FLIP against the static control",
                                             r.direction(d), name, h),
                                 paper, gain->second));
            }
        }
    }
    return list;
}

}  // namespace

ReportSection table3_section(const Reproduced& r) {
    ReportSection section{"section-table3", "Table 3: rendering the forecast", {}};
    std::vector<std::string> problems;
    const auto ours = ours_or_reason(r, "materials", read_ours_materials, problems);
    if (ours) section.blocks.push_back(sentences(r, *ours));
    add_problems(problems, section);
    for (const char* what : {"flip", "lpips"})
        section.blocks.push_back(distances(r, ours ? &*ours : nullptr, what));
    add_picture(r, "materials", "renders/u010.png",
                {"table3-materials",
                 "The materials of one window at +10",
                 "Forecast, true future and FLIP's map." + r.caution(),
                 {}},
                section);
    add_commands(r, {"materials"}, section);
    return section;
}

}  // namespace verdigris
