// SPDX-License-Identifier: MIT
// The changes from frame to frame of a context, as fields over the specimen (internal).
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/forecast/band_split.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

using ColorField = std::array<Field, 3>;     ///< red, green, blue
using Increments = std::vector<ColorField>;  ///< frame i + 1 less frame i; 0 outside of what moves

/// Under the light of the last frame; without `light`: as they are.
Increments increments_of(const Context& context, const Mask& moving, const LightGains& light);

Image<SrgbF> image_of(const std::vector<const ColorField*>& planes,
                      const Eigen::RowVectorXd& weights, const Image<SrgbF>& like);
/// Mean over channels and pixels inside.
double mean_square_difference(const Image<SrgbF>& a, const Image<SrgbF>& b, const Mask& inside);

}  // namespace verdigris
