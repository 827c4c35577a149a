// SPDX-License-Identifier: MIT
// A smooth luma under a glint, from the unclipped metal around it (internal).
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Where `clipped` lies on the specimen: luma interpolated from the unclipped specimen pixels of
/// the canvas, near ones counting more (push-pull over a pyramid). -1 elsewhere, and everywhere if
/// there is nothing to interpolate from. Empty masks: all specimen, none clipped.
Image<float> fill_luma(const Image<SrgbF>& canvas, const Mask& specimen, const Mask& clipped);

/// The same for any number per pixel, in place: those under `clipped` on the specimen follow from
/// around them, the rest stays. False, and nothing changed, if there is nothing to fill or to fill
/// from.
bool fill_values(Image<float>& values, const Mask& specimen, const Mask& clipped);

/// The same for colors, in place: `holes` on the specimen take the colors around them.
void fill_colors(Image<SrgbF>& image, const Mask& specimen, const Mask& holes);

}  // namespace verdigris
