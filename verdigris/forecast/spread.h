// SPDX-License-Identifier: MIT
// How far off a forecast is expected to be, at any horizon.
// Model: docs/models/bandtrend.md
#pragma once

#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Variances of encoded sRGB, at a horizon.
struct SpreadNode {
    double horizon = 0;
    double common = 0;  ///< of what all of the specimen shares
    double own = 0;     ///< of what each pixel has for itself, on average
    bool operator==(const SpreadNode&) const = default;
};

/// A frame's value differs from the forecast by a standard deviation of
///     sqrt(common(h) common_c + own(h) own_c(x))
/// in channel c of pixel x; its own noise is included. Both laws are linear from 0 to and between
/// nodes, whose horizons increase from above 0, and held beyond. Nothing is known without nodes.
struct Spread {
    SrgbF common{1, 1, 1};  ///< share of the channels, mean 1
    Image<SrgbF> own;       ///< share of the pixels, mean 1 over what moves; 0 where nothing does
    std::vector<SpreadNode> nodes;

    bool known() const { return !nodes.empty(); }
    /// At a horizon of 0 or more; held beyond the last node.
    SpreadNode at(double horizon) const;
};

/// Half widths of an interval in standard deviations: two-sided, of Student's t with 5 degrees of
/// freedom, scaled to unit variance. chosen: an average of models that are off by different amounts
/// has tails, and simulated recordings have those (docs/models/bandtrend.md).
inline constexpr double kHalfWidth80 = 1.1432148684060779, kHalfWidth95 = 1.9911641278965480;
/// Of the mean color: through the same 80 %, with the tails of 3 degrees of freedom (t at 97.5 %
/// and 90 %: 3.1824 and 1.6377). chosen: it has fewer parts to average out (as above).
inline constexpr double kMeanHalfWidth80 = kHalfWidth80, kMeanHalfWidth95 = 2.2215;

/// Standard deviation per pixel and channel into `out` (resized if needed).
void spread_image(const Spread& spread, double horizon, Image<SrgbF>& out);
/// Of the mean color of the specimen: root of the common part, per channel.
SrgbF spread_of_mean(const Spread& spread, double horizon);

}  // namespace verdigris
