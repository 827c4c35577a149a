// SPDX-License-Identifier: MIT
// A report as a folder: the page to read, and each table and figure in the formats that others
// need.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/progress.h"
#include "verdigris/report/page.h"
#include "verdigris/report/table.h"
#include "verdigris/status.h"

namespace verdigris {

struct WrittenResults {
    /// Relative to the folder, in the order written: for the manifest.
    std::vector<std::filesystem::path> files;
    /// "figures_left_out" (no gnuplot), "points_left_out" (not finite, or not above zero on a
    /// logarithmic axis), "page_is_static" (this build has no scripts).
    Statuses statuses;
};

/// Writes into `folder` (a StagedFolder's path(): then all of it appears at once, or nothing)
///   tables/<id>.csv, .json, .tex   each table of the report, in its order
///   figures/<id>.svg, .png         each figure; none without gnuplot, with a Status saying so
///   figures/<id>.png               each picture
///   report.html                    with the statuses above shown at its top
/// `data_tables` are written as CSV only and not shown: per-window errors, for recomputing.
/// Same report, same bytes, given the same gnuplot. Progress stage: "report".
/// Throws Error{failed}: what cannot be written (check_report), a failing gnuplot, a full disk.
WrittenResults write_results(const Report& report, const std::filesystem::path& folder,
                             const std::vector<Table>& data_tables = {},
                             const Progress& progress = {});

}  // namespace verdigris
