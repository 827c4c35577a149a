// SPDX-License-Identifier: MIT
// Reading the frames behind RecentUnits (internal).
#pragma once

#include "verdigris/observe/crop.h"
#include "verdigris/observe/recent_units.h"
#include "verdigris/observe/unit_axis.h"
#include "verdigris/progress.h"

namespace verdigris {

/// What `look` has is not read again. Of photographs the last 20 units are; of long videos 7 to 12,
/// so few that no more is decoded than for the look. Fewer where the end of the recording does not
/// decode. `plan`: of the frames that decode.
RecentUnits recent_units(const Recording& recording, const Look& look,
                         const SpecimenFinding& finding, Rect crop, const AxisPlan& plan,
                         const Progress& progress);

}  // namespace verdigris
