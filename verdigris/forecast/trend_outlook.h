// SPDX-License-Identifier: MIT
// How the error of a trend would be if more were recorded, later, or with less noise: what its
// likely models say, each of itself (internal).
#pragma once

#include <map>
#include <tuple>

#include "verdigris/forecast/trend_models.h"

namespace verdigris {

/// The first so many of kTrendUnits, one unit apart: what an expected error is the mean of.
inline constexpr int kOutlookUnits = 10;

struct Circumstances {
    int increments = 0;  ///< frames - 1; at least 1
    double later = 0;    ///< units after the last frame of the trend
    double noise = 1;    ///< of a frame, in variance; 0: none
};

/// Keeps the moments of each drift that it was asked for: they cost more than all else.
class TrendOutlook {
  public:
    /// `doubt`: see TrendPrior.
    explicit TrendOutlook(double doubt) : doubt_(doubt) {}

    /// Mean square error over the next kOutlookUnits, in the unit of the gram that the trend was
    /// made of, less the noise of the frames it is compared with, if its likely models were the
    /// only ones and known. What the models disagree about is not in it, nor steps and outliers.
    double expected_error(const Trend& trend, const Circumstances& circumstances);

  private:
    double error_of(const TrendKind& kind, const Circumstances& c);
    const DriftMoments& part(const TrendKind& kind, int increments);

    double doubt_;
    std::map<std::tuple<bool, double, double, double, double, double, int>, DriftMoments> drifts_;
};

/// Variance of the noise of one frame, as the likely models have it, in the same unit.
double frame_noise(const Trend& trend);

}  // namespace verdigris
