// SPDX-License-Identifier: MIT
// Which forecaster? By name, or the one its own context supports best.
#pragma once

#include <string>
#include <vector>

#include "verdigris/forecast/affine.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

struct ChooseOptions {
    double ridge_k = 30;
    FitPixels pixels{FitPixels::all};
    bool clamp = true;
};

/// One row of the back-test: a candidate's error on frames it was not shown.
struct BacktestRow {
    std::string forecaster;
    double mean_squared_error = 0;     ///< over specimen pixels that are not clipped
    double gain_over_persistence = 0;  ///< 1 - error / persistence error
    int frames_predicted = 0;
};

/// `auto`: the best there is without training, bandtrend (band_trend.h), under the name "auto".
Forecaster automatic(const ChooseOptions& options = {});

/// "backtest": rolling-origin back-test of persistence and the affine family inside the context;
/// the winner is refitted on all of it. Persistence wins ties, and whenever the context is too
/// short to hold anything back. The explanation quotes the evidence.
Forecaster back_tested(const ChooseOptions& options = {});
std::vector<BacktestRow> backtest(const Context& context, const ChooseOptions& options = {});

/// "auto", "bandtrend", "backtest", "persistence", "affinergb" (full), "affinergb-full-1",
/// "affinergb-per-channel-2", ...; "bandtrend:bands=0" (band_trend_design.h). Throws Error{usage}
/// listing the names.
Forecaster forecaster_by_name(const std::string& name, const ChooseOptions& options = {});
std::vector<std::string> forecaster_names();

}  // namespace verdigris
