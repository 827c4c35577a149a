// SPDX-License-Identifier: MIT
// Does a color channel turn around inside the context? Copper's interference path reverses
// individual channels; a drift fitted through the turn points nowhere (internal).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// A turn of one series at t = 0..n-1.
struct Turn {
    double at = 0;                       ///< where the fitted parabola turns
    bool rises_first = true;             ///< a peak; false: a trough
    double left_arm = 0, right_arm = 0;  ///< how far it went before and came back after
};

/// The turn, if there is one that jitter does not explain and whose both arms exceed `min_arm`.
std::optional<Turn> find_turn(std::span<const double> series, double min_arm);

struct Reversal {
    int channel = 0;   ///< 0 red, 1 green, 2 blue
    Turn turn;         ///< of the specimen's mean, or of the median tile that turns
    double share = 0;  ///< of the specimen's area in tiles that turn the same way
};

/// Channels whose mean over the specimen turns, or that turn in a quarter of its area.
std::vector<Reversal> find_reversals(const Context& context);

}  // namespace verdigris
