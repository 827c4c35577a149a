// SPDX-License-Identifier: MIT
// Do a forecast's intervals hold what they promise?
#pragma once

#include "verdigris/evaluate/foreground.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// Shares inside the nominal 80 % and 95 % intervals; NaN where the forecast states none.
struct Coverage {
    double pixels80, pixels95;  ///< of channels of the pixels of `area` that may move
    double mean80, mean95;      ///< of the three channels of their mean color: thirds
};

/// `forecast` is `frame` at horizon `h`; `truth` of the same size. `scratch` keeps its memory.
Coverage coverage_of(const Spread& spread, double h, const Image<SrgbF>& frame,
                     const Image<SrgbF>& truth, const PixelWeights& area, Image<SrgbF>& scratch);

}  // namespace verdigris
