// SPDX-License-Identifier: MIT
// How far off the delivered horizons may be, for people and for the manifest.
#pragma once

#include <string>
#include <vector>

#include "verdigris/deliver/delivery.h"

namespace verdigris {

/// Half widths of intervals at a horizon, encoded sRGB in 0..1, mean of the channels.
struct Uncertainty {
    double horizon = 0;
    double mean80 = 0, mean95 = 0;    ///< of the specimen's mean color
    double pixel80 = 0, pixel95 = 0;  ///< of its pixels, root mean square
};

/// Of each delivered horizon; empty where the forecaster states no interval.
std::vector<Uncertainty> uncertainty_of(const Delivery& delivery);

/// An encoded value as codes of 255: "4.2", from ten on "13".
std::string codes_text(double value);

/// "Four times in five, ...": of the first and the last horizon; empty if nothing is stated.
std::string uncertainty_sentence(const std::vector<Uncertainty>& list);

}  // namespace verdigris
