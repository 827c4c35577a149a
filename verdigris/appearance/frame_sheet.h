// SPDX-License-Identifier: MIT
// Judged frames to look at: what the forecasters say of one window, below what came.
#pragma once

#include <cstddef>

#include "verdigris/appearance/material_judgment.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// The paper's Figures 1 and 2, of one direction (an index): the last observed frame and the true
/// ones in the first row, a row per forecaster below, a column per horizon; under each frame how
/// far it is from the last observed one, all on one scale, which the sheet says. Horizons beyond
/// the protocol's K, so beyond what anything was trained for, are marked. Text is set in DejaVu
/// Sans. Throws Error{usage} if there is no example, Error{failed} if the sheet cannot be drawn.
Image<SrgbU8> draw_frame_sheet(const MaterialJudgment& judgment, std::size_t direction);

}  // namespace verdigris
