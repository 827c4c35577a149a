// SPDX-License-Identifier: MIT
// Taps of a Gaussian, as docs/VIEWER_DATA.md fixes them for the viewer too (internal).
#pragma once

#include <vector>

namespace verdigris {

/// Half of a symmetric kernel: taps[0] in the middle, then outwards to radius ceil(3 sigma); the
/// whole kernel sums to 1. sigma 0 gives {1}.
std::vector<float> gaussian_taps(double sigma);

}  // namespace verdigris
