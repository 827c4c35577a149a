// SPDX-License-Identifier: MIT
// Rolling-origin back-test inside a context, with the evidence `auto` decides on (internal).
#pragma once

#include <optional>
#include <vector>

#include "verdigris/forecast/choose.h"

namespace verdigris {

struct BacktestTrial {
    BacktestRow row;
    std::optional<AffineOptions> affine;  ///< empty: persistence
    double improvement = 0;     ///< of the error over persistence, less what noise alone explains
    double standard_error = 0;  ///< of `improvement`, over the origins
    bool beats_persistence = false;
};

/// Persistence first. Empty if the context is too short to hold enough back (n < 5).
std::vector<BacktestTrial> run_backtest(const Context& context, const ChooseOptions& options);

}  // namespace verdigris
