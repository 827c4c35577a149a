// SPDX-License-Identifier: MIT
// How far the trends of a context can be trusted: until where they beat holding still, and how far
// off they may be (internal).
// Model: docs/models/bandtrend.md
#pragma once

#include <Eigen/Core>
#include <vector>

#include "verdigris/forecast/band_components.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/forecast/spread.h"

namespace verdigris {

/// By how many standard deviations the forecast is expected to be closer than the last frame, in
/// squared error, at each of kTrendUnits. Infinite where nothing is forecast to change.
Eigen::VectorXd expected_advantage(const std::vector<Component>& components);

/// Of a forecast that is held from kTrendUnits[held] on. Includes light that wanders, as the
/// backdrop shows it: where it will be is not known.
Spread spread_of(const Context& context, const Mask& moving, const Components& components, int held,
                 TrendModelsCache& models);

}  // namespace verdigris
