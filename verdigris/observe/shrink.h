// SPDX-License-Identifier: MIT
// A stored sample made smaller before its color is made: a box mean of coded samples, which is the
// color of the box mean, as the matrix is linear.
#pragma once

#include "verdigris/observe/sample_layout.h"

namespace verdigris {

/// The largest factor, at most `wanted`, by which a sample shrinks without a rest in any plane;
/// 1 if there is none, or if color does not follow linearly from the codes.
int shrink_factor(const SampleLayout& layout, int wanted);

/// The sample shrunk by shrink_factor(layout, wanted), as encoded sRGB in [0, 1]. O(codes).
Image<SrgbF> shrunk_sample(const SampleLayout& layout, const SampleCodes& codes, int wanted);

}  // namespace verdigris
