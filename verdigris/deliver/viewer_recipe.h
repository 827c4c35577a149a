// SPDX-License-Identifier: MIT
// A forecast small enough to travel inside a web page, whose recipe still means the same surface.
#pragma once

#include "verdigris/deliver/delivery.h"
#include "verdigris/deliver/resample.h"

namespace verdigris {

/// chosen: the long side of what the viewer shows. 1024 x 1024 makes a page of about 20 MB and is
/// more than its canvas on most screens; the packs keep the full size.
inline constexpr int kViewerSide = 1024;

/// The images of stage 3 and the options that go with them, at the viewer's size.
struct ViewerRecipe {
    MaterialOptions options;
    Image<SrgbF> canvas;
    Image<float> dead_zone;
    Image<float> active;     ///< 1 or 0
    Image<float> luma_fill;  ///< >= 0 where clipped, -1 elsewhere
};

/// Color images and the dead-zone by area average (so max(tau, |x0 - C|) still covers the averaged
/// difference); active by majority; luma_fill over filled pixels only, where they are the majority.
/// Lengths in pixels (height_sigma, micro_sigma) shrink with the picture, and normal_gain with
/// them, because a step between coarse pixels spans several fine ones: same slopes.
ViewerRecipe viewer_recipe(const MaterialRecipe& recipe, PictureSize extent);

}  // namespace verdigris
