// SPDX-License-Identifier: MIT
// Figures with everything a report draws, from made numbers: to look at, and for the browser test.
#pragma once

#include <vector>

#include "verdigris/report/figure.h"

namespace verdigris {

/// Errors by horizon on a log scale with bands; gains by block with intervals; a drift in two
/// panels; eleven curves with long names.
std::vector<Figure> sample_figures();

}  // namespace verdigris
