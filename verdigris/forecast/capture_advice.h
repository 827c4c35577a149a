// SPDX-License-Identifier: MIT
// Is it worth recording on? What the forecaster would gain from more frames, by its own models of
// the change that it saw.
// Model: docs/models/bandtrend.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verdigris/observe/recent_units.h"

namespace verdigris {

/// The error to be expected over the ten units that follow, if the recording had gone on.
struct CaptureOutlook {
    double units = 0;   ///< more than now
    double frames = 0;  ///< as many more, at the present pace
    double error = 0;   ///< root mean square, encoded units; noise of the frames to come left out
};

struct CaptureAdvice {
    /// "too_few", "still", "enough", "record_on", "light", "noise", "unforeseen"
    std::string id;
    std::string sentence;
    /// Now: as CaptureOutlook::error. 0 where `id` is "too_few" or "still".
    double error = 0;
    /// Of its square, 0 to 1: what four times as many photographs per unit would take away, what
    /// the light does, and change that would be unforeseen if all else was known.
    double noise_share = 0, light_share = 0, unforeseen_share = 0;
    bool backdrop = false;                 ///< enough of it is in view to see the light on
    std::optional<CaptureOutlook> halved;  ///< the first that is at most half; in coarse steps
    std::vector<CaptureOutlook> outlooks;  ///< farther and farther, never worse
};

/// By the models of `band_trend`, each as likely as it finds it: the error that would be left of
/// each component with more increments to learn from, later on in a drift that slows down, or with
/// less noise. Never throws on account of the data; the sentence says what is missing. Forecasts
/// nothing: about the work of one forecast of small frames.
CaptureAdvice capture_advice(const RecentUnits& recent);

}  // namespace verdigris
