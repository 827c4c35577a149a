// SPDX-License-Identifier: MIT
// How far the trends of a context can be trusted: until where they beat holding still, and how far
// off they may be (internal).
// Model: docs/models/bandtrend.md
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "verdigris/forecast/band_components.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/forecast/spread.h"

namespace verdigris {

/// By how many standard deviations the forecast of those that count is expected to be closer than
/// the last frame, in squared error, at each of kTrendUnits. Infinite where nothing is forecast to
/// change.
Eigen::VectorXd expected_advantage(const std::vector<Component>& components,
                                   const std::function<bool(const Component&)>& counts);

/// Of a forecast whose components are held where they say.
Spread spread_of(const Mask& moving, const Components& components);

/// Mean square of what a component would still change after it is held, per kTrendUnits.
Eigen::VectorXd withheld(const Component& component);

}  // namespace verdigris
