// SPDX-License-Identifier: MIT
// The paper's deployment rules, as sentences a user understands.
#pragma once

#include <vector>

#include "verdigris/forecast/forecast.h"

namespace verdigris {

inline constexpr int kMinContext = 5;  ///< below, worse than doing nothing [Paper, Section 8]

/// ids: "few_frames" (refusal: n < 5), "long_horizon" (caution: beyond 2 n, names the horizons),
/// "color_reversal" (caution: a channel turned inside the context, names it), "out_of_gamut"
/// (caution above 1 %: share per horizon, and whether the clamp held it), "mostly_clipped"
/// (caution: over 20 % of the specimen saturated), "no_change" (info: the context moved less than
/// its noise), "exposure_jump" (caution: one step moved specimen and backdrop together),
/// "light_ramp" (caution: backdrop and specimen brighten or darken together, steadily).
Statuses check_guards(const Context& context, const Forecast& forecast,
                      const std::vector<double>& horizons);

/// Throws Error{refused} with the first refusal's sentence, if there is one.
void refuse_if_needed(const Statuses& guards);

}  // namespace verdigris
