// SPDX-License-Identifier: MIT
// Is the camera drifting, and does a forecaster's gain survive when its drift is taken out?
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "verdigris/evaluate/evaluate.h"
#include "verdigris/observe/drift_correction.h"
#include "verdigris/observe/reference_region.h"
#include "verdigris/results/resolved.h"

namespace verdigris {

/// One forecaster on the recording as it is, or corrected.
struct DriftGain {
    std::string forecaster;
    std::optional<DriftCorrection> correction;  ///< none: as recorded
    Resolved gain;                              ///< no window: nothing changes any more
    double error = 0, persistence = 0;          ///< mean foreground MSE; NaN without windows
    WindowRatios ratios;
};

struct RecordingDrift {
    std::string name;
    int stride = 1;  ///< samples per unit
    ReferenceRegion region;
    std::optional<DriftSeries> series;  ///< none where no reference region was found
    /// One per correction, one map per sample; none without a series.
    std::vector<std::pair<DriftCorrection, std::vector<ChannelMap>>> maps;
    /// As recorded for every forecaster, then each correction for every forecaster.
    std::vector<DriftGain> gains;
    Statuses notes;  ///< of the evaluations
    std::vector<std::string> sentences;

    /// Throws Error{usage} if there is none.
    const DriftGain& gain_of(const std::string& forecaster,
                             std::optional<DriftCorrection> correction) const;
};

std::string to_string(std::optional<DriftCorrection> correction);  ///< "none" too

/// Windows within the recording, as `protocol` says but for `single`, since nothing is trained.
/// The smoothing window is the paper's 101 samples at 10 per unit, as many units elsewhere.
/// `not_backdrop` is the specimen and what else cannot be backdrop; empty: the specimen's mask.
/// Cost: four evaluations, or one where there is no reference. Throws as evaluate().
RecordingDrift measure_recording_drift(const EvaluationProtocol& protocol,
                                       const Observation& observation,
                                       const std::vector<Entrant>& entrants,
                                       const Mask& not_backdrop = {},
                                       const Progress& progress = {});

/// Fills `sentences` from the numbers: called by measure_recording_drift.
std::vector<std::string> drift_sentences(const RecordingDrift& drift);

}  // namespace verdigris
