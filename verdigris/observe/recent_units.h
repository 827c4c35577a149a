// SPDX-License-Identifier: MIT
// The end of a recording at a glance: one small picture per unit. Enough to ask what more of the
// recording would be worth, not to make a forecast of.
#pragma once

#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/observe/inspect.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Long side of these pictures, in pixels at most. chosen: the size at which forecasts are judged.
inline constexpr int kRecentSide = 128;

struct RecentUnits {
    /// Single frames, one unit apart, the last frame's unit last, 20 at most; all of one size. Of
    /// the crop that --crop auto would choose. A unit without a frame has the one between its
    /// neighbors'.
    std::vector<Image<SrgbF>> frames;
    Mask specimen;                 ///< of their size
    int frames_recorded = 0;       ///< in all
    double units = 0;              ///< that they span
    double frames_per_unit = 0;    ///< of the recording
    double seconds_per_unit = 0;   ///< on its own clock; 0: it has none
    double frames_per_sample = 1;  ///< how many a forecast averages where here is one
    bool still = false;            ///< nothing in the frame changes more than the noise
};

/// inspect(), and what the end of the recording shows, as far as it decodes. Of long videos about
/// as many frames are decoded again.
Inspection inspect(const Recording& recording, RecentUnits& recent, const Progress& progress = {});

}  // namespace verdigris
