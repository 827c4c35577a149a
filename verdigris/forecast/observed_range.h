// SPDX-License-Identifier: MIT
// A forecaster kept inside the colors that its context shows: a cheap bound on a drift that does
// not end by itself.
#pragma once

#include <vector>

#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// `inner`, whose channels stop where they would leave the range of the context's colors, widened
/// by `margin` of its extent at both ends and at most [0, 1]; a pixel that begins outside is kept
/// from going further. The range of a channel is that of the 1st to the 99th percentile of all
/// frames' pixels that are neither backdrop nor clipped (chosen: a speck must not set it; the half
/// is chosen too, and by nobody's data). A stack of frames at `horizons`, which increase from above
/// 0. Throws Error{usage}: a margin below 0, no horizon.
Forecaster within_observed_range(Forecaster inner, std::vector<double> horizons,
                                 double margin = 0.5);

}  // namespace verdigris
