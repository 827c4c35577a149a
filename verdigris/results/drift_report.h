// SPDX-License-Identifier: MIT
// The drift of the camera, and gains before and after it is taken out: the paper's Figure 4.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "verdigris/report/page.h"
#include "verdigris/results/drift_verdict.h"

namespace verdigris {

/// Sections: verdict, the light, gains, how it was done.
Report drift_report(const EvaluationProtocol& protocol, const std::vector<RecordingDrift>& list);

/// One row per recording: the region, movements, ratio, correlation.
Table drift_table(const std::vector<RecordingDrift>& list);
/// One row per recording, forecaster and correction.
Table drift_gain_table(const std::vector<RecordingDrift>& list);
/// Per recording: mean RGB of specimen and reference on the left, gains on the right.
Figure drift_figure(const std::vector<RecordingDrift>& list);
/// What the reference alone did, which is too little to be seen beside the specimen.
Figure reference_figure(const std::vector<RecordingDrift>& list);

/// Per sample: means and spread as measured and smoothed.
Table drift_series_table(const std::vector<RecordingDrift>& list);
/// Per sample and correction: corrected = gain * x + offset, per channel.
Table drift_map_table(const std::vector<RecordingDrift>& list);
/// Every window's error, means over horizons: the gains follow from it.
Table drift_windows(const std::vector<RecordingDrift>& list);

nlohmann::ordered_json json_of(const EvaluationProtocol& protocol,
                               const std::vector<RecordingDrift>& list);

}  // namespace verdigris
