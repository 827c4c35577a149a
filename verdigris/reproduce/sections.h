// SPDX-License-Identifier: MIT
// One section of the report per table or figure of the paper (internal). Each stands with n/a and
// the reason where ours could not be made; none throws for a result that is missing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/report/page.h"
#include "verdigris/reproduce/reproduced.h"

namespace verdigris {

ReportSection table1_section(const Reproduced& r);
ReportSection table2_section(const Reproduced& r);
ReportSection table3_section(const Reproduced& r);
ReportSection figures12_section(const Reproduced& r);
ReportSection figure3_section(const Reproduced& r);
ReportSection figure4_section(const Reproduced& r);
ReportSection figure5_section(const Reproduced& r);
ReportSection training_section(const Reproduced& r);
ReportSection copper_section(const Reproduced& r);

/// A result of ours, or nothing and the reason among `problems`.
template <class Read>
auto ours_or_reason(const Reproduced& r, const std::string& id, const Read& read,
                    std::vector<std::string>& problems) -> std::optional<decltype(read(r.folder))> {
    if (!r.has(id)) {
        problems.push_back(id + ": n/a, " + r.why_not(id) + ".");
        return {};
    }
    try {
        return read(r.folder / r.task(id)->outputs.front());
    } catch (const Error& e) {
        problems.push_back(id + ": n/a, " + std::string(e.what()) + ".");
        return {};
    }
}

/// "Made by" with the commands of those that are there; nothing where none is.
void add_commands(const Reproduced& r, const std::vector<std::string>& ids, ReportSection& section);
/// The reasons as callouts.
void add_problems(const std::vector<std::string>& problems, ReportSection& section);
/// A PNG of a result folder as a picture of the report; nothing where it is not there.
void add_picture(const Reproduced& r, const std::string& task, const std::filesystem::path& file,
                 Picture picture, ReportSection& section);
/// Stands where the paper prints nothing.
TableCell not_printed();
TableCell paper_cell(std::optional<double> value);

}  // namespace verdigris
