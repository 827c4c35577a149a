// SPDX-License-Identifier: MIT
// Judged materials to look at: forecast, truth and FLIP's map of one window, side by side.
#pragma once

#include "verdigris/appearance/material_judgment.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// A sheet for one horizon (an index): a column of rows for each direction, one row per forecaster,
/// each forecast | truth | map. Maps share a scale, 0 to the 99.5th percentile of them all rounded
/// up to 1, 2 or 5 times a power of ten, which the sheet says. Text is set in DejaVu Sans.
/// Throws Error{usage} if there is no example, Error{failed} if the sheet cannot be drawn.
Image<SrgbU8> draw_material_contact(const MaterialJudgment& judgment, std::size_t horizon);

}  // namespace verdigris
