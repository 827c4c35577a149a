// SPDX-License-Identifier: MIT
// How different two colors look.
#pragma once

#include "verdigris/color/pixel_types.h"

namespace verdigris {

/// CIEDE2000 color difference with kL = kC = kH = 1; 1 is about the smallest difference seen side
/// by side. Symmetric; 0 for equal colors; NaN if an input is. Computed in double, ~0.2 us.
/// Source: [CIE15]; the hue cases as [Sharma2005] settles them, whose 34 pairs are the test.
double delta_e2000(Lab first, Lab second);

}  // namespace verdigris
