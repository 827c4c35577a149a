// SPDX-License-Identifier: MIT
// Figure 5: does what a network believes of a surface hold elsewhere? And did the networks learn?
#include <fmt/format.h>

#include <array>
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

constexpr NumberFormat kR{NumberStyle::fixed, 2, true};

TableCell r_cell(const OursCorrelation& c) {
    if (!std::isfinite(c.r)) return {};
    return std::isfinite(c.error) ? TableCell(c.r, {c.r - c.error, c.r + c.error}) : TableCell(c.r);
}

}  // namespace

ReportSection figure5_section(const Reproduced& r) {
    ReportSection section{"section-figure5", "Figure 5: why a network does not transfer", {}};
    std::vector<std::string> problems;
    const std::vector<std::string> ids{"susceptibility-first", "susceptibility-second"};
    std::array<std::optional<OursSusceptibility>, 2> ours;
    for (std::size_t i = 0; i < 2; ++i)
        ours[i] = ours_or_reason(r, ids[i], read_ours_susceptibility, problems);
    const auto printed = [](const char* row, const char* column) {
        return *paper_value("figure5", kNoDirection, row, column);
    };
    Table table;
    table.id = "figure5";
    table.title = "Figure 5: agreement of the susceptibility maps";
    table.caption =
        "Pearson's r. The paper's are of one network and do not say over which pixels; ours are "
        "over the metal, with one jackknife standard error around them." +
        r.caution();
    table.columns = {
        {"what", "What", Align::left},
        {"paper", "paper", Align::right, kR, true},
        {"first", fmt::format("ours, learned from {}", r.recording(0)), Align::right, kR, true},
        {"second", fmt::format("ours, learned from {}", r.recording(1)), Align::right, kR, true}};
    const TableCell within((printed("within", "least") + printed("within", "most")) / 2,
                           {printed("within", "least"), printed("within", "most")});
    const auto row = [&](const char* title, const TableCell& paper, auto&& pick) {
        TableRow cells{TableCell(title), paper};
        for (const auto& one : ours) cells.push_back(one ? r_cell(pick(*one)) : TableCell());
        table.add_row(std::move(cells));
    };
    row("windows of the recording it learned from (paper: range)", within,
        [](const auto& s) { return s.within[0]; });
    row("windows of the other recording (paper: range)", within,
        [](const auto& s) { return s.within[1]; });
    row("windows of one with windows of the other", TableCell(printed("cross", "r")),
        [](const auto& s) { return s.cross; });
    row("with what really changed, recording it learned from",
        TableCell(printed("change", "source")), [](const auto& s) { return s.change[0]; });
    row("with what really changed, the other recording", TableCell(printed("change", "held_out")),
        [](const auto& s) { return s.change[1]; });
    BulletList list;
    for (std::size_t i = 0; i < 2; ++i) {
        if (!ours[i]) continue;
        const std::string of = fmt::format("patinanet of {}", r.recording(int(i)));
        list.items.push_back(compare_correlation(of + ", between specimens", printed("cross", "r"),
                                                 ours[i]->cross.r, ours[i]->cross.error));
        list.items.push_back(compare_correlation(of + ", with what really changed where it learned",
                                                 printed("change", "source"), ours[i]->change[0].r,
                                                 ours[i]->change[0].error));
        list.items.push_back(compare_correlation(of + ", with what really changed where it did not",
                                                 printed("change", "held_out"),
                                                 ours[i]->change[1].r, ours[i]->change[1].error));
    }
    if (!list.items.empty()) {
        section.blocks.push_back(std::move(list));
    }
    add_problems(problems, section);
    section.blocks.push_back(std::move(table));
    for (int i = 0; i < 2; ++i)
        add_picture(r, ids[std::size_t(i)], "maps.png",
                    {fmt::format("figure5-maps-{}", i + 1),
                     fmt::format("Susceptibility as patinanet of {} has it", r.recording(i)),
                     "Left what it believes, right where the specimen really changed; above " +
                         r.recording(0) + ", below " + r.recording(1) + "." + r.caution(),
                     {}},
                    section);
    add_commands(r, ids, section);
    return section;
}

ReportSection training_section(const Reproduced& r) {
    ReportSection section{"section-training", "Section 6: did the networks learn at all?", {}};
    std::vector<std::string> problems, ids;
    Table table;
    table.id = "training";
    table.title = "Best validation error on the recording learned from";
    table.caption =
        "Foreground MSE on the part of the same recording that chooses the epoch, and its gain "
        "over holding still there, which the paper does not print." +
        r.caution();
    table.group_header = "learned from";
    table.columns = {{"network", "Network", Align::left},
                     {"paper", "paper", Align::right, kError},
                     {"ours", "ours", Align::right, kError},
                     {"gain", "gain, ours", Align::right, kGain},
                     {"epoch", "epoch kept", Align::right}};
    BulletList list;
    for (const int d : {kChamberToAir, kAirToChamber}) {
        RowGroup group{
            fmt::format("{}; ours {}", d == kChamberToAir ? "chamber" : "air", r.recording(d)), {}};
        for (const std::string& network : paper_networks()) {
            const double printed = *paper_value("training", d, network, "validation");
            const std::string id =
                fmt::format("train-{}", trained_run(network, d).filename().string());
            std::optional<OursTraining> ours;
            if (r.task(id)) {
                ids.push_back(id);
                ours = ours_or_reason(r, id, read_ours_training, problems);
            }
            group.rows.push_back(
                {TableCell(network), TableCell(printed),
                 ours ? finite_or_missing(ours->validation) : TableCell(),
                 ours ? finite_or_missing(1 - ours->validation / ours->persistence) : TableCell(),
                 ours ? TableCell(fmt::format("{} of {}", ours->epoch, ours->epochs))
                      : TableCell()});
            if (ours)
                list.items.push_back(compare_error(fmt::format("{} on {}", network, r.recording(d)),
                                                   printed, ours->validation));
        }
        table.groups.push_back(std::move(group));
    }
    if (!list.items.empty()) section.blocks.push_back(std::move(list));
    add_problems(problems, section);
    section.blocks.push_back(std::move(table));
    add_commands(r, ids, section);
    return section;
}

}  // namespace verdigris
