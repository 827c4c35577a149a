// SPDX-License-Identifier: MIT
// What the closed-form forecaster needs, as a report: the paper's Table 2 and Figure 3.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "verdigris/evaluate/characterize.h"
#include "verdigris/report/page.h"
#include "verdigris/results/characterization_verdict.h"

namespace verdigris {

/// Sections: verdict, Table 2 with the contexts drawn, long horizons, how it was done.
Report characterization_report(const EvaluationProtocol& protocol, const Characterization& table,
                               const CharacterizationVerdict& verdict);

/// One row per setting; per direction error and gain. Holding still has rows of its own where the
/// windows are others, as in the paper.
Table characterization_table(const Characterization& table, const CharacterizationVerdict& verdict);
/// Some of the horizons, per direction.
Table long_horizon_table(const CharacterizationVerdict& verdict);
Figure context_figure(const Characterization& table, const CharacterizationVerdict& verdict);
/// Error by horizon on a log scale, persistence pinned.
Figure long_horizon_figure(const CharacterizationVerdict& verdict);
Figure out_of_gamut_figure(const CharacterizationVerdict& verdict);
/// Every window's error of every setting, means over horizons: the table follows from it.
Table characterization_windows(const Characterization& table);

nlohmann::ordered_json json_of(const EvaluationProtocol& protocol, const Characterization& table,
                               const CharacterizationVerdict& verdict);

}  // namespace verdigris
