// SPDX-License-Identifier: MIT
// What the closed-form forecaster needs and which of its parts earn their place: the paper's
// Table 2, the confound it leaves open, and how far a drift can be followed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "verdigris/evaluate/bootstrap.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/forecast/affine.h"

namespace verdigris {

/// The forecaster as the paper has it: all pixels, no ridge, no clamp.
AffineOptions paper_affine(AffineFamily family = AffineFamily::full, int order = 1);

struct CharacterizeOptions {
    std::vector<int> contexts{3, 5, 7, 10};  ///< frames observed
    std::vector<double> ridges{0, 3, 30, 300};
    int windows = 60;  ///< evenly spaced per configuration, as the paper's sweep; 0: all
};

/// One configuration on one held-out recording.
struct CharacterizationCell {
    double error = 0;        ///< mean foreground MSE
    double persistence = 0;  ///< of the same windows, which shift with the context's length
    double gain = 0;         ///< 1 - error / persistence
    WindowRatios ratios;     ///< for bootstrap()
};

struct CharacterizationRow {
    /// "context", "family", "order": one axis each, as the paper. "fit-pixels": the three families
    /// fitted to all pixels and to the specimen's, of which only the specimen's are moved and
    /// counted, so that the backdrop's share in "channels must be allowed to mix" is seen.
    /// "ridge": the full family at several strengths.
    std::string block;
    std::string setting;                      ///< "n = 5", "full 3x3 + bias (12)", ...
    bool usual = false;                       ///< the paper's dagger: what is used everywhere else
    std::vector<CharacterizationCell> cells;  ///< one per direction
    int context = 0;  ///< frames observed: with it its windows' span changes
};

struct Characterization {
    std::vector<std::string> directions;
    std::vector<CharacterizationRow> rows;
    Statuses notes;
};

/// Everything else as `protocol` says (its context is the usual one). Nothing is trained.
/// Cost: contexts + 2 evaluations. Throws as evaluate(); Error{refused} naming a recording of which
/// no window could be scored.
Characterization characterize(const EvaluationProtocol& protocol,
                              std::span<const Observation> observations,
                              const CharacterizeOptions& options = {},
                              const Progress& progress = {});

/// The furthest horizon that leaves at least one window in a recording of `samples`; 0 if none.
int longest_horizon(const EvaluationProtocol& protocol, int samples);

/// An evaluation out to `horizon` units, or as far as the shortest recording allows, of
/// persistence, "affinergb clamped", "affinergb unclamped" (paper_affine otherwise) and `others`:
/// curves per horizon, the share of pixels that leave [0, 1], and, as persistence's `absolute`, how
/// far the specimen moves. The foreground is what changes within these horizons. Throws as
/// evaluate().
Evaluation long_horizons(const EvaluationProtocol& protocol,
                         std::span<const Observation> observations, int horizon = 85,
                         const std::vector<Entrant>& others = {}, const Progress& progress = {});

}  // namespace verdigris
