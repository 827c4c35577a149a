// SPDX-License-Identifier: MIT
// Where in the frame the specimen is: from what changes and what looks like copper.
#pragma once

#include <string>
#include <vector>

#include "verdigris/observe/exposure.h"
#include "verdigris/observe/look.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

enum class SpecimenKind {
    found,        ///< one candidate stands out
    fills_frame,  ///< nearly everything changes, up to the border
    still,        ///< nothing changes more than the noise
    ambiguous,    ///< several candidates, or one too small
};

/// What the look shows. Coordinates are those of the look.
struct SpecimenFinding {
    SpecimenKind kind{};
    Mask mask;                ///< all inside unless found or ambiguous (then the best guess)
    Rect box;                 ///< the 1..99 % range of the mask's coordinates
    double area_share = 0;    ///< mask over the frame
    double score_ratio = 0;   ///< best candidate over the runner-up; 0 if only one
    std::vector<Gain> gains;  ///< of the unchanging majority, every look against the first
    bool majority = true;     ///< false: nothing to measure the gain on
    double change = 0;        ///< mean |last - first| inside the mask, gains removed, encoded units
};

/// Spec E.1 with the deviations listed in docs/models/observe.md. Deterministic.
SpecimenFinding find_specimen(const Look& look);

/// From look coordinates to the frame: padded by 8 %, square where the frame allows, inside the
/// frame, even.
Rect crop_around(Rect box, const Look& look);

/// The crop and the sentence. Does not throw: an ambiguous finding gives the best guess.
CropReport crop_report(const SpecimenFinding& finding, const Look& look);

/// The mask of the part `rect` of the frame, at width x height.
Mask specimen_mask(const SpecimenFinding& finding, const Look& look, Rect rect, int width,
                   int height);

}  // namespace verdigris
