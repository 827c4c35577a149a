// SPDX-License-Identifier: MIT
// Is this recording fit for a forecast? Looks at up to 64 frames and says so in sentences.
#pragma once

#include <string>
#include <vector>

#include "verdigris/pixels/image.h"
#include "verdigris/progress.h"
#include "verdigris/recording/recording.h"
#include "verdigris/status.h"

namespace verdigris {

enum class Verdict { good, usable, poor, unusable };

struct Inspection {
    int frames = 0;
    double duration_seconds = 0;
    double median_step_seconds = 0, longest_step_seconds = 0;
    double units = 0;  ///< accelerated units the recording would span
    int samples_per_unit = 0;
    double noise_sigma = 0;      ///< of a single frame, encoded units
    double specimen_change = 0;  ///< mean |last - first| over the specimen, encoded units
    /// Largest relative change of the unchanging majority's level, and of its channel ratios. 0 and
    /// not known where there is nothing but specimen to measure them on.
    double exposure_drift = 0, white_balance_drift = 0;
    bool drift_known = false;
    double clipped_share = 0;  ///< of specimen pixels saturated in some frame
    double largest_jump = 0;   ///< largest frame-to-frame mean step over the typical one
    int largest_jump_frame = -1;
    Rect crop;  ///< what --crop auto would choose
    std::string crop_sentence;
    Verdict verdict{};
    std::string verdict_sentence;
    Statuses findings;  ///< the weightiest first
};

/// Throws as observe() does for inputs that cannot be read at all; anything that can be read gets
/// a verdict instead.
Inspection inspect(const Recording& recording, const Progress& progress = {});

std::string to_string(Verdict verdict);

}  // namespace verdigris
