// SPDX-License-Identifier: MIT
// Materials judged, as a report: sentences, tables, figures, JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "verdigris/appearance/material_judgment.h"
#include "verdigris/report/page.h"
#include "verdigris/results/resolved.h"

namespace verdigris {

/// One forecaster, one horizon.
struct MaterialVerdict {
    double flip = 0, control = 0;  ///< means over windows
    Resolved gain;                 ///< 1 - flip / control, with what the windows resolve
};
/// Names that end so are the forecaster before them with a limit on where its colors may go.
inline constexpr const char* kClampedSuffix = "-clamped";
inline constexpr const char* kInRangeSuffix = "-in-range";

/// A limited forecaster against the free one, one horizon.
struct FixVerdict {
    std::string free, limited;
    std::size_t horizon = 0;  ///< an index
    double flip_free = 0, flip_limited = 0;
    Resolved difference;  ///< gain(limited) - gain(free): positive where the limit helps
};
struct MaterialDirectionVerdict {
    const MaterialDirection* direction = nullptr;
    /// Rows without the first, which is the static control; by horizon.
    std::vector<std::vector<MaterialVerdict>> rows;
    std::vector<FixVerdict> fixes;
    std::vector<std::string> sentences;
};

/// Mean over the windows that have a number at this horizon; NaN if none has.
double mean_where_finite(const ErrorTable& table, std::size_t horizon);

/// `judgment` must outlive the result.
std::vector<MaterialDirectionVerdict> material_verdicts(const MaterialJudgment& judgment);

/// Per forecaster FLIP and gain at each horizon: the paper's Table 3. Ids: flip_u5, gain_u5 ...
Table material_table(const MaterialJudgment& judgment,
                     const std::vector<MaterialDirectionVerdict>& list);
/// One row per forecaster and horizon: every measure, and how the forecast moved.
Table material_measure_table(const MaterialJudgment& judgment,
                             const std::vector<MaterialDirectionVerdict>& list);
Table material_fix_table(const MaterialJudgment& judgment,
                         const std::vector<MaterialDirectionVerdict>& list);
Table material_block_table(const MaterialJudgment& judgment,
                           const std::vector<MaterialDirectionVerdict>& list);
/// Everything per window, forecaster and horizon: all else can be computed again from it.
Table material_windows(const MaterialJudgment& judgment);
Figure material_flip_figure(const MaterialJudgment& judgment);
Figure material_gain_figure(const MaterialJudgment& judgment,
                            const std::vector<MaterialDirectionVerdict>& list);

/// Sections: verdict, leakage audit, materials, gamut and movement, how sure, how it was done.
Report material_report(const MaterialJudgment& judgment,
                       const std::vector<MaterialDirectionVerdict>& list);

nlohmann::ordered_json json_of(const MaterialJudgment& judgment,
                               const std::vector<MaterialDirectionVerdict>& list);

}  // namespace verdigris
