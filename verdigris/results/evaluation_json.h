// SPDX-License-Identifier: MIT
// An evaluation as JSON: the stable --json output, and what was used, for `verdigris audit`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "verdigris/evaluate/evaluate.h"
#include "verdigris/results/evaluation_report.h"

namespace verdigris {

/// Direction -> forecaster -> errors per horizon and mean, gain, intervals, block gains. Numbers
/// that are not finite are null.
nlohmann::ordered_json json_of(const Evaluation& evaluation,
                               const std::vector<DirectionVerdict>& verdicts);

/// What was used, complete: audit(record_from(json_of(record))) is audit(record).
nlohmann::ordered_json json_of(const EvaluationRecord& record);
/// Throws Error{bad_input} (`where` names the file) if it is no record of ours.
EvaluationRecord record_from(const nlohmann::ordered_json& json, const std::string& where);

}  // namespace verdigris
