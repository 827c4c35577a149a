// SPDX-License-Identifier: MIT
// The formula of the cloth (internal).
#pragma once

#include "verdigris/pixels/image.h"

namespace verdigris {

struct DrapePoint {
    Vec3F position, along_u, along_v;  ///< and its derivatives
};
/// u, v in [0, 1]; v = 1 is nearest to the viewer. docs/models/render.md has the formula.
DrapePoint drape_point(double u, double v);

}  // namespace verdigris
