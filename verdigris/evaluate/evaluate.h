// SPDX-License-Identifier: MIT
// The held-out protocol: forecasters are judged on recordings that nothing was learned from.
// Path: observe, forecast -> [evaluate].   Model: docs/PROTOCOL.md
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "verdigris/evaluate/audit.h"
#include "verdigris/evaluate/protocol.h"
#include "verdigris/evaluate/scores.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/observe/observe.h"
#include "verdigris/progress.h"
#include "verdigris/status.h"

namespace verdigris {

/// What a trained forecaster may learn from: one of the recordings that are not held out.
struct TrainingSource {
    std::string name;
    /// Its samples note which of them are read, and the audit compares that with the two ranges.
    /// Lives until `train` returns.
    const Observation* observation = nullptr;
    SampleRange train, validation;
};

/// A forecaster as it enters. The forecast function is called from several threads at once.
struct Entrant {
    std::string name;       ///< as it appears in results; unique
    Forecaster forecaster;  ///< if training-free
    /// If trained: called once per held-out recording, with all others.
    std::function<Forecaster(const std::vector<TrainingSource>&)> train;

    bool trained() const { return bool(train); }
};
/// Under the forecaster's own name.
Entrant training_free(Forecaster forecaster);

/// A window that was scored, for who wants to know more of it than its errors.
struct ScoredWindow {
    const Direction& direction;  ///< what was planned for it; its tables are not full yet
    const Observation& observation;
    int start = 0;           ///< first sample
    const Context& context;  ///< what the forecasters saw
    /// Of persistence, then of the entrants in their order.
    std::span<const Forecast> forecasts;
    /// The true frame `unit` units after the last of the context, 1 to protocol.horizons.
    std::function<const Image<SrgbF>&(int unit)> truth;
};
/// Called for one window at a time, in their order, between two windows; may throw.
using WindowVisitor = std::function<void(const ScoredWindow&)>;

struct Evaluation {
    EvaluationProtocol protocol;
    std::vector<Direction> directions;  ///< one per recording, in their order
    EvaluationRecord record;            ///< what was used, for audit()
    Statuses notes;                     ///< the audit's findings first
    /// Cautions about the recordings themselves, each beginning with its name: cut off, few frames.
    Statuses recording_notes;
};

/// Holds out each observation in turn (protocol.single: evaluates each by itself, labeled so) and
/// scores persistence, which is added where it is not entered, and every entrant on all windows of
/// the protocol. A forecaster sees a Context and nothing else, a copy that it cannot look beyond.
///
/// Memory: one recording as floats, at most 800 MB, else refused. Cost, 128 x 128, two cores: see
/// docs/PROTOCOL.md. Deterministic at any thread count. `progress` stages: "hash", "train", "load",
/// "evaluate".
/// With `visit` windows are scored one by one, and each that is scored is shown to it.
/// Throws Error{usage}: the protocol, no observation, two entrants of one name. Error{bad_input}
/// naming the recording: too short, not the grid's samples, not every sample kept, too large.
/// Error{refused}: one recording without protocol.single; a trained forecaster with it, or where a
/// source's splits do not fit; two copies, or near copies, of one recording. Error{failed}: a
/// forecast of another size, or not finite.
Evaluation evaluate(const EvaluationProtocol& protocol, std::span<const Observation> observations,
                    const std::vector<Entrant>& entrants, const Progress& progress = {},
                    const WindowVisitor& visit = {});

}  // namespace verdigris
