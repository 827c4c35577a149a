// SPDX-License-Identifier: MIT
// Which source frame falls into which bin of the unit axis. Needs the time stamps only.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "verdigris/observe/observe.h"
#include "verdigris/status.h"

namespace verdigris {

/// chosen: below this many frames a unit grid would average pairs here and single frames there; one
/// frame per sample keeps every sample equally noisy.
inline constexpr double kFramesForUnitGrid = 1.5 * kUnitsPerRecording;

/// The axis and the bin of every source frame, known before a frame is decoded.
struct AxisPlan {
    UnitAxis axis;
    double span_seconds = 0;            ///< first to last frame, plus one typical step
    double step_seconds = 0;            ///< the median step between frames
    bool one_frame_per_sample = false;  ///< sample i is frame i
    std::vector<int> bin_of_frame;      ///< non-decreasing
    std::vector<int> frames_in_bin;
    Statuses notes;  ///< equal or irregular time stamps
};

/// Rule (docs/models/observe.md, 1): without `units`, >= 1.5 * 98.4 frames span 98.4 units with
/// clamp(floor(frames / 98.4), 1, 10) samples each; fewer frames are one sample, one unit each.
/// With `units`, the recording spans that many. `times` has at least 2 entries.
/// Throws Error{usage}: units not positive, or more units than frames.
AxisPlan plan_axis(const std::vector<double>& times, std::optional<double> units);

/// Which samples are kept: all, or one per unit counted back from the last.
std::vector<bool> kept_samples(const UnitAxis& axis, Keep keep);

/// The axis cut after sample `samples` - 1: what is left of a recording with a broken tail.
UnitAxis truncated(const UnitAxis& axis, int samples);

/// [first, last) of the samples that the paper uses: it loses 17 of 984 at each end [Paper].
/// Authoring keeps the ends; an evaluation takes this range.
std::pair<int, int> paper_valid_range(int samples);

}  // namespace verdigris
