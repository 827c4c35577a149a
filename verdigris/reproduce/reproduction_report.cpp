// SPDX-License-Identifier: MIT
#include "verdigris/reproduce/reproduction_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/reproduce/sections.h"

namespace verdigris {
namespace {

ReportSection summary(const Reproduced& r) {
    ReportSection section{"section-summary", "What this is", {}};
    if (r.options.quick)
        section.blocks.push_back(
            Status{"quick", Severity::caution,
                   "quick: not the paper's settings. Recordings are small and short, windows few, "
                   "one network saw eight windows once, so that the numbers say that everything "
                   "runs and nothing else."});
    section.blocks.push_back(Paragraph{
        "Each table and figure of the paper, its printed values beside ours. The paper's two "
        "recordings are not public, so its numbers cannot be made again: ours differ from them "
        "before anything is computed."});
    section.blocks.push_back(Paragraph{
        r.options.recordings.empty()
            ? "Ours are simulated: presets chamber and air of `verdigris simulate`, seed 1, one "
              "specimen each. They were made to be like such recordings in movement, noise and "
              "light, by what is known of copper and cameras (docs/models/simulate.md). What holds "
              "on them holds on a simulator."
            : fmt::format("Ours are the recordings given: {} in the place of the paper's chamber, "
                          "{} in that of its open air. They are other specimens in other "
                          "conditions.",
                          r.recording(0), r.recording(1))});
    section.blocks.push_back(Paragraph{
        "Sentences that compare are computed: whether signs agree, and whether the paper's value "
        "lies within our block interval. Intervals come from few blocks and cover less than their "
        "nominal 95 % (docs/PROTOCOL.md); that two numbers differ is nowhere called significant."});
    std::vector<std::string> failed, missing, skipped;
    for (std::size_t i = 0; i < r.outcomes.size(); ++i) {
        const Task& task = r.graph.tasks()[i];
        const TaskOutcome& o = r.outcomes[i];
        if (o.state == TaskState::failed)
            section.blocks.push_back(Status{"task_failed", Severity::refusal,
                                            fmt::format("{} failed: {}", task.title, o.sentence)});
        if (o.state == TaskState::missing) missing.push_back(task.title);
        if (o.state == TaskState::skipped) skipped.push_back(task.title);
    }
    if (!missing.empty())
        section.blocks.push_back(Status{
            "tasks_missing", Severity::caution,
            fmt::format("This build cannot do {} of the {} tasks; their rows are n/a, with the "
                        "reason.",
                        missing.size(), r.outcomes.size())});
    if (!skipped.empty())
        section.blocks.push_back(
            Status{"tasks_skipped", Severity::caution,
                   fmt::format("{} tasks were skipped, because what they need is not there.",
                               skipped.size())});
    return section;
}

/// An audit that was not made found nothing because it did not look.
std::string audit_sentence(const Reproduced& r) {
    std::size_t made = 0, clean = 0, other = 0;
    for (std::size_t i = 0; i < r.outcomes.size(); ++i) {
        if (r.graph.tasks()[i].kind != "audit") continue;
        const bool failed = r.outcomes[i].state == TaskState::failed;
        const bool done = r.has(r.graph.tasks()[i].id);
        made += done || failed;
        clean += done;
        other += !done && !failed;
    }
    std::string text = fmt::format(
        "{} of {} audits that were made found nothing: no leak, and errors, gains and intervals "
        "follow from the windows they are made of.",
        clean, made);
    if (made == 0) text = "No audit was made.";
    if (other > 0 && made > 0)
        text += fmt::format(" {} more {} not made: what {} look at is not there.", other,
                            other == 1 ? "was" : "were", other == 1 ? "it would" : "they would");
    return text;
}

}  // namespace

Table task_table(const Reproduced& r) {
    Table table;
    table.id = "tasks";
    table.title = "Every command";
    table.caption =
        "What was run, in the result folder; wall time on the threads it had, beside whatever else "
        "ran. Logs and records: tasks/.";
    table.columns = {{"task", "Task", Align::left},
                     {"state", "State", Align::left},
                     {"seconds", "wall, s", Align::right, {NumberStyle::fixed, 1, false}},
                     {"cpu", "CPU, s", Align::right, {NumberStyle::fixed, 1, false}},
                     {"threads", "threads", Align::right, {NumberStyle::integer, 0, false}},
                     {"command", "Command", Align::left}};
    for (const std::size_t i : r.graph.order()) {
        const TaskOutcome& o = r.outcomes[i];
        const bool ran = o.threads > 0;
        table.add_row({TableCell(r.graph.tasks()[i].id), TableCell(to_string(o.state)),
                       ran ? TableCell(o.wall_seconds) : TableCell(),
                       ran ? TableCell(o.cpu_seconds) : TableCell(),
                       ran ? TableCell(o.threads) : TableCell(),
                       TableCell(command_text(r.graph.tasks()[i]))});
    }
    return table;
}

Report reproduction_report(const Reproduced& r) {
    Report report;
    report.title = "The paper's tables and figures, made again";
    report.subtitle = r.options.quick ? "quick: not the paper's settings"
                      : r.options.recordings.empty()
                          ? "on simulated recordings"
                          : fmt::format("on {} and {}", r.recording(0), r.recording(1));
    report.sections = {summary(r),           table1_section(r),   figure3_section(r),
                       figure4_section(r),   training_section(r), figure5_section(r),
                       figures12_section(r), table2_section(r),   table3_section(r),
                       copper_section(r)};
    ReportSection how{"section-tasks", "How it was made", {}};
    how.blocks.push_back(Paragraph{audit_sentence(r)});
    how.blocks.push_back(task_table(r));
    report.sections.push_back(std::move(how));
    return report;
}

nlohmann::ordered_json json_of(const Reproduced& r) {
    nlohmann::ordered_json tasks = nlohmann::ordered_json::array();
    for (const std::size_t i : r.graph.order()) {
        const TaskOutcome& o = r.outcomes[i];
        tasks.push_back({{"id", r.graph.tasks()[i].id},
                         {"title", r.graph.tasks()[i].title},
                         {"state", to_string(o.state)},
                         {"sentence", o.sentence},
                         {"command", command_text(r.graph.tasks()[i])},
                         {"wall_seconds", o.wall_seconds},
                         {"cpu_seconds", o.cpu_seconds},
                         {"threads", o.threads}});
    }
    return {{"quick", r.options.quick}, {"tasks", std::move(tasks)}};
}

}  // namespace verdigris
