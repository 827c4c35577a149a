// SPDX-License-Identifier: MIT
// The filters of FLIP, all separable or sums of two that are, as halves: tap 0 is the center, tap i
// stands i pixels to either side (internal).
#pragma once

#include <vector>

namespace verdigris {

struct FlipFilters {
    /// What the eye blurs: luminance and red-green, each of sum 1. Outer taps that no float sum of
    /// values around 1 can see are left out.
    std::vector<float> luma, red_green;
    /// Blue-yellow is wide * wide + narrow * narrow, both along columns and along rows.
    std::vector<float> blue_wide, blue_narrow;
    /// What features are found with: a Gaussian of sum 1; its first derivative, whose tap i weighs
    /// v[i] - v[-i]; its second, whose taps sum to 0 over both sides and the center.
    std::vector<float> smooth, edge, point;

    int reach() const;  ///< pixels to either side that any of them sees
};

/// luma is no longer than smooth, and red_green no longer than blue_wide. `pixels_per_degree` at
/// least 1. Source: [Andersson2020], Sections 4.1 and 4.2, normalized as their code does.
FlipFilters flip_filters(double pixels_per_degree);

}  // namespace verdigris
