// SPDX-License-Identifier: MIT
#include "verdigris/observe/drift.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace verdigris {
namespace {

// chosen: the paper's reference region moved by 0.001 and 0.026 of full scale while the specimens
// moved by about 0.12 [Paper]; from about twice the larger of the two on, drift is a visible part
// of the change. Color errors show earlier than brightness errors.
constexpr double kExposure = 0.05, kWhiteBalance = 0.02;

}  // namespace

Drift measure_drift(const SpecimenFinding& finding) {
    Drift drift;
    drift.known = finding.majority && finding.kind != SpecimenKind::fills_frame;
    if (!drift.known) return drift;
    drift.alone = finding.kind == SpecimenKind::still;
    for (const Gain& gain : finding.gains) {
        const double level = gain.level();
        if (std::fabs(level - 1) > drift.exposure) {
            drift.exposure = std::fabs(level - 1);
            drift.brighter = level > 1;
        }
        for (const double c : {gain.r, gain.g, gain.b}) {
            drift.white_balance = std::max(drift.white_balance, std::fabs(c / level - 1));
        }
    }
    return drift;
}

void note_drift(const Drift& drift, Statuses& notes) {
    if (!drift.known) {
        notes.push_back(
            {"light_unknown", Severity::info,
             "nothing in the frame shows the light alone (a backdrop that is neither "
             "copper-colored nor black nor overexposed), so light that drifts cannot be "
             "told from aging"});
        return;
    }
    if (drift.exposure > kExposure) {
        const char* direction = drift.brighter ? "brighter" : "darker";
        notes.push_back(
            {"exposure_drift", Severity::caution,
             drift.alone
                 ? fmt::format("the whole picture, backdrop included, gets up to {:.0f} % {}, and "
                               "nothing changes beside: this is the light or the exposure, not the "
                               "copper",
                               100 * drift.exposure, direction)
                 : fmt::format("the backdrop moves with the specimen, it gets up to {:.0f} % {}: "
                               "that part of what looks like aging may be the light, not the "
                               "copper; keep lamp and exposure fixed",
                               100 * drift.exposure, direction)});
    }
    if (drift.white_balance > kWhiteBalance) {
        notes.push_back({"white_balance_drift", Severity::caution,
                         fmt::format("the white balance drifts by {:.0f} % over the recording; "
                                     "lock it, or colors will be forecast that the metal never had",
                                     100 * drift.white_balance)});
    }
}

}  // namespace verdigris
