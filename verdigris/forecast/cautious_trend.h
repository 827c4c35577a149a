// SPDX-License-Identifier: MIT
// A trend that counts a loss for more than a gain (internal).
// Model: docs/models/bandtrend.md
#pragma once

#include "verdigris/forecast/trend_models.h"

namespace verdigris {

/// Of the change that a trend foretells, what takes back the last frame's noise stays as it is. The
/// rest is shrunk, at each of kTrendUnits by itself, by the c that is best for
/// (1 - c)^2 f^2 + caution c^2 e^2: what is forgone of its mean square f^2, and what is risked, e^2
/// being that of its error without the noise of the frame to come. c = f^2 / (f^2 + caution e^2).
/// The error grows by what is forgone. `gram`: what the trend was made of. `caution`: 0 or more;
/// with 0 nothing changes.
void be_cautious(Trend& trend, const Eigen::MatrixXd& gram, double caution);

}  // namespace verdigris
