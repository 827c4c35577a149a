// SPDX-License-Identifier: MIT
// What a characterization says in words: every sentence follows from a number in it.
#pragma once

#include <string>
#include <vector>

#include "verdigris/evaluate/characterize.h"
#include "verdigris/results/resolved.h"

namespace verdigris {

/// How far a drift can be followed, on one held-out recording.
struct LongVerdict {
    std::string direction;
    int horizons = 0, windows = 0, independent = 0;
    /// Per horizon k = 0 .., t + (k + 1): foreground MSE; empty if no window was scored.
    std::vector<double> persistence, clamped, unclamped;
    std::vector<double> outside, outside_by_a_step;  ///< shares of pixels, unclamped
    std::vector<double> moved;  ///< mean |truth - last observed| over the specimen
    /// Horizons (1 ..) at which the unclamped forecast is on another side of persistence than one
    /// before: increasing.
    std::vector<int> crossings;
};

struct CharacterizationVerdict {
    std::vector<std::vector<Resolved>> gains;  ///< as Characterization::rows, one per direction
    std::vector<LongVerdict> far;              ///< one per direction
    std::vector<std::string> sentences;
};

/// `far` is what long_horizons() gave. `protocol` gives stride, horizons and the bootstrap.
/// Paired differences where two settings were scored on the same windows; contexts are not, and
/// are only ordered.
CharacterizationVerdict characterization_verdict(const EvaluationProtocol& protocol,
                                                 const Characterization& table,
                                                 const Evaluation& far);

}  // namespace verdigris
