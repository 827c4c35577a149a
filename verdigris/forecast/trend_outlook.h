// SPDX-License-Identifier: MIT
// How the error of a trend would be if more were recorded, later, or with less noise: what its
// likely models say, each of itself (internal).
#pragma once

#include "verdigris/forecast/trend_models.h"

namespace verdigris {

/// The first so many of kTrendUnits, one unit apart: what an expected error is the mean of.
inline constexpr int kOutlookUnits = 10;

struct Circumstances {
    int increments = 0;  ///< frames - 1; at least 1
    double later = 0;    ///< units after the last frame of the trend
    double noise = 1;    ///< of a frame, in variance; 0: none
};

/// Mean square error over the next kOutlookUnits, in the unit of the gram that the trend was made
/// of, less the noise of the frames it is compared with, if its likely models were the only ones
/// and known. What the models disagree about is not in it, nor steps and outliers.
double expected_error(const Trend& trend, double doubt, const Circumstances& circumstances);

/// Variance of the noise of one frame, as the likely models have it, in the same unit.
double frame_noise(const Trend& trend);

}  // namespace verdigris
