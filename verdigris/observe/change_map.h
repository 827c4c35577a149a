// SPDX-License-Identifier: MIT
// What changed between the first and the last looks, in units of the noise, and what looks like
// copper. The evidence that crop.cpp weighs.
#pragma once

#include <vector>

#include "verdigris/observe/exposure.h"
#include "verdigris/observe/look.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

struct ChangeMap {
    int width = 0, height = 0;
    std::vector<float> z;       ///< |late - early| over the noise, smoothed; row-major
    std::vector<float> change;  ///< mean over channels of |late - early|, encoded units
    Mask copper;                ///< hue and chroma of copper in the early look, or its color
    std::vector<Gain> gains;    ///< every look against the first
    bool majority = true;       ///< see SpecimenFinding
    Image<SrgbF> early;         ///< median of the first looks
};

ChangeMap change_map(const Look& look);

}  // namespace verdigris
