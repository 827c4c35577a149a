// SPDX-License-Identifier: MIT
// A part of the picture that cannot oxidize: the neutral backdrop, found by its looks alone. What
// moves there is the camera or the light, never the metal ([Paper], Section 6).
#pragma once

#include <cstdint>
#include <string>

#include "verdigris/color/pixel_types.h"
#include "verdigris/observe/observe.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

struct ReferenceOptions {
    int first_samples = 20;        ///< [Paper]: the first twenty frames, so never later change
    double distance = 0.06;        ///< kept from the specimen; share of the shorter side
    double erosion = 0.03;         ///< kept from whatever is not neutral; share of the shorter side
    double smallest_part = 0.01;   ///< of the picture; smaller connected parts are dropped
    std::int64_t pixels = 2000;    ///< needed in all, but at most ...
    double share_of_small = 0.02;  ///< ... this share of the picture. chosen: 328 at 128 x 128
};

struct ReferenceRegion {
    Mask mask;                ///< of the samples' size; empty if nothing was found
    std::int64_t pixels = 0;  ///< inside
    /// Of the distance and erosion asked for: 1, or 1/2 or 1/4 where only that left enough, as in
    /// a crop with a narrow rim of backdrop. The closer, the more the specimen's light tints it.
    double margin = 1;
    std::string sentence;  ///< what was found, or why nothing
    bool found() const { return pixels > 0; }
};

/// The per-pixel median of the first `count` samples (all there are, if fewer), encoded sRGB; of an
/// even count the mean of the two middle values. Holds them at 16 bits meanwhile.
Image<SrgbF> median_of_first(const SampleStore& samples, int count);

/// Neutral (C* < 8, 8 < L* < 95, no channel above 0.98) in the median of the first samples, away
/// from the specimen and from whatever is not neutral, in parts of 1 % of the picture or more. A
/// region measured on a crop and one measured on the whole frame differ; this takes what it is
/// given. `specimen` has the samples' size; add the mount to it if it is neutral. Deterministic.
/// Throws Error{usage}: no samples, a mask of another size, options out of range.
ReferenceRegion find_reference_region(const SampleStore& samples, const Mask& specimen,
                                      const ReferenceOptions& options = {});

}  // namespace verdigris
