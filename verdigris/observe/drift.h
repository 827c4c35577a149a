// SPDX-License-Identifier: MIT
// How much the light itself moved: exposure and white balance of what did not change.
#pragma once

#include "verdigris/observe/crop.h"
#include "verdigris/status.h"

namespace verdigris {

struct Drift {
    double exposure = 0;       ///< largest |gain - 1| against the first look
    bool brighter = false;     ///< there; darker if false
    bool alone = false;        ///< nothing but the light moves: the scene is still without it
    double white_balance = 0;  ///< largest |channel gain / mean gain - 1|
    bool known = false;        ///< false: nothing but specimen to measure it on
};

Drift measure_drift(const SpecimenFinding& finding);
/// "exposure_drift", "white_balance_drift" where they matter; "light_unknown" where there is
/// nothing to measure them on.
void note_drift(const Drift& drift, Statuses& notes);

}  // namespace verdigris
