// SPDX-License-Identifier: MIT
// The light of each frame, read off what lies behind the specimen and does not age (internal).
#pragma once

#include <array>
#include <vector>

#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// Per frame, and channel: how much brighter the last frame is.
using LightGains = std::vector<std::array<double, 3>>;

/// Per frame and channel: how much brighter, in linear light, the light of the last frame is for
/// the specimen. Read off the backdrop (pixels outside the specimen and not at its edge, not
/// clipped, not black): the median over pixels, which a moving minority does not shift; 1 where
/// something stands before most of it, and to the power of the share, 0 to 1.5, that the specimen
/// has of that light. Where there are not 200 of them to see: of the whole picture, if one gray
/// gain per frame is all that happens to it, noise aside; else all 1.
LightGains backdrop_light(const Context& context);

/// Is there backdrop enough to see the light on?
bool shows_light(const Context& context);

/// `frame` with its linear light multiplied by `gain`.
Image<SrgbF> relit(const Image<SrgbF>& frame, const std::array<double, 3>& gain);

}  // namespace verdigris
