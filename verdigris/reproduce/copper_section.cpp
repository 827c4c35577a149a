// SPDX-License-Identifier: MIT
// What real copper adds: one specimen, judged within itself.
#include <cmath>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/reproduce/compare.h"
#include "verdigris/reproduce/ours.h"
#include "verdigris/reproduce/sections.h"
#include "verdigris/results/cells.h"

namespace verdigris {
namespace {

void add_group(const std::string& title, const OursDirection& judged, Table& table) {
    RowGroup group{title, {}};
    for (const OursForecaster& f : judged.forecasters)
        group.rows.push_back({TableCell(f.name), finite_or_missing(f.mean),
                              f.gain ? cell_of(*f.gain) : not_printed(),
                              finite_or_missing(f.delta_e)});
    table.groups.push_back(std::move(group));
}

}  // namespace

ReportSection copper_section(const Reproduced& r) {
    ReportSection section{"section-copper", "Real copper", {}};
    if (r.options.copper.empty()) {
        section.blocks.push_back(Paragraph{
            "None was given (--copper FOLDER): everything above that is ours is simulated or of "
            "the recordings given."});
        return section;
    }
    section.blocks.push_back(Paragraph{
        "One real specimen, judged within its own recording: nothing is held out, and n = 1 for "
        "any claim about copper. The paper has no such table; it stands here because the "
        "simulated recordings are only as much like copper as the simulator."});
    std::vector<std::string> problems;
    Table table;
    table.id = "copper";
    table.title = "Within the real recording";
    table.caption =
        "Foreground MSE, gain over holding still, and mean CIEDE2000; 5 or 10 frames observed, 10 "
        "forecast, three samples per unit.";
    table.group_header = "observed";
    table.columns = {{"forecaster", "Forecaster", Align::left},
                     {"error", "MSE", Align::right, kError},
                     {"gain", "gain", Align::right, kGain, true},
                     {"delta_e", "CIEDE2000", Align::right, {NumberStyle::fixed, 2, false}}};
    BulletList list;
    for (const auto& [id, title] :
         {std::pair("copper", "n = 5"), std::pair("copper-10", "n = 10")}) {
        const auto judged = ours_or_reason(r, id, read_ours_single, problems);
        if (!judged) continue;
        add_group(title, *judged, table);
        for (const OursForecaster& f : judged->forecasters)
            if (f.gain && std::isfinite(f.gain->value))
                list.items.push_back(std::string(title) + ", " + f.name + ": " +
                                     signed_percent(f.gain->value) + "; " + how_sure(*f.gain) +
                                     ".");
    }
    const auto sweep = ours_or_reason(
        r, "copper-characterize",
        [](const auto& folder) { return read_ours_characterization(folder, 1); }, problems);
    Table settings;
    settings.id = "copper-settings";
    settings.title = "Table 2's axes on the real recording";
    settings.caption = "Foreground MSE of affinergb and its gain over holding still.";
    settings.group_header = "axis";
    settings.columns = {{"setting", "Setting", Align::left},
                        {"error", "MSE", Align::right, kError},
                        {"gain", "gain", Align::right, kGain, true}};
    if (sweep) {
        for (const OursSetting& s : sweep->settings) {
            if (s.axis == "fit-pixels" || s.axis == "ridge" || s.cells.empty()) continue;
            if (settings.groups.empty() || settings.groups.back().title != s.axis)
                settings.groups.push_back({s.axis, {}});
            settings.groups.back().rows.push_back({TableCell(s.setting),
                                                   finite_or_missing(s.cells[0].error),
                                                   cell_of(s.cells[0].gain)});
        }
    }
    if (!list.items.empty()) section.blocks.push_back(std::move(list));
    add_problems(problems, section);
    if (!table.groups.empty()) section.blocks.push_back(std::move(table));
    if (!settings.groups.empty()) section.blocks.push_back(std::move(settings));
    add_commands(r, {"copper", "copper-10", "copper-characterize"}, section);
    return section;
}

}  // namespace verdigris
