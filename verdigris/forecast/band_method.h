// SPDX-License-Identifier: MIT
// What bandtrend does before it makes a picture: which pixels move, what their change is made of,
// and until where each part of it is followed (internal).
// Model: docs/models/bandtrend.md
#pragma once

#include "verdigris/forecast/band_components.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// Of longer contexts the last so many frames count.
inline constexpr int kLongestContext = 40;

/// What all forecasts of one forecaster have in common. For several threads at once.
struct BandMethod {
    BandTrendDesign design;
    BandModels models{design.prior};
};

/// The components of the change, each with where it is held.
Components held_components(const Context& context, const Mask& moving, BandMethod& method);

/// `count` frames of a context from `begin` on.
Context part_of(const Context& context, int begin, int count);

}  // namespace verdigris
