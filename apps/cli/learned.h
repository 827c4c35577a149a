// SPDX-License-Identifier: MIT
// Trained forecasters on the command line. Built twice: learned.cpp where there is libtorch,
// learned_absent.cpp where there is none, which says how to get it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "session.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/observe/observe.h"

namespace verdigris::cli {

/// Does a name on the command line mean a checkpoint?
bool is_checkpoint(const std::string& name);

/// train, susceptibility. In a build without libtorch they are refused with a sentence.
void add_learned_commands(CLI::App& app, Session& session);

/// Why this build has no networks, as a sentence; empty where it has.
std::string no_networks_because();

/// Reads them: what is wrong with one is told before anything else is done.
void check_checkpoints(const std::vector<std::string>& paths);
/// Checkpoints as entrants of an evaluation. Throws as read_checkpoint and checkpoint_entrants.
std::vector<Entrant> learned_entrants(const std::vector<std::string>& paths,
                                      const EvaluationProtocol& protocol);

/// A checkpoint as the forecaster of `age`: what it forecasts at `horizons`, and how many frames it
/// must see. `notes` says if it learned from another recording, or never looked that far.
struct LearnedForecaster {
    Forecaster forecaster;
    int context = 0;
    Statuses notes = {};
};
LearnedForecaster learned_forecaster(const std::string& path, const std::vector<double>& horizons,
                                     const Observation& observation);

/// LPIPS of two pictures, or why there is none: no weights were given, no libtorch in this build,
/// or pictures too small. Weights that cannot be used throw as Lpips does; `net` "" is whichever
/// they are of.
struct LpipsOutcome {
    std::optional<double> distance;
    std::string net, version, why_not;
};
LpipsOutcome lpips_of(const std::string& weights, const std::string& net,
                      const Image<SrgbF>& reference, const Image<SrgbF>& test);

/// The same for many pictures: the weights are read once. `distance` is empty where `why_not` says
/// why.
struct LpipsMeasure {
    std::function<double(const Image<SrgbF>& reference, const Image<SrgbF>& test)> distance;
    std::string why_not;
};
LpipsMeasure lpips_measure(const std::string& weights, int width, int height);

}  // namespace verdigris::cli
