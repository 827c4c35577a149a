// SPDX-License-Identifier: MIT
// Exposure and white balance: the gain of the unchanging majority between two pictures, and sudden
// steps of it from frame to frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/recording/recording.h"
#include "verdigris/status.h"

namespace verdigris {

/// Per channel: image = gain * reference, for what did not change.
struct Gain {
    double r = 1, g = 1, b = 1;
    double level() const { return (r + g + b) / 3; }
};

/// Iteratively reweighted least squares with Tukey weights, started where a third of the pixels
/// agrees best, so that what changed has no say.
/// Only pixels in `where` (empty: all) that are neither clipped in one of the pictures nor too dark
/// for a ratio; none if those are less than a twentieth of `where` or fewer than 16.
std::optional<Gain> robust_gain(const Image<SrgbF>& reference, const Image<SrgbF>& image,
                                const Mask& where);

SrgbF apart_from(SrgbF value, const Gain& gain);  ///< value / gain, per channel

/// Watches the median ratio of a lattice of coded samples from each frame to the next.
class JumpWatch {
  public:
    explicit JumpWatch(const FrameFormat& format) : format_(format) {}
    void add(const Frame& frame);
    /// "exposure_jump" for the largest step, if it stands out; it names the frame.
    std::optional<Status> finding() const;

  private:
    struct Step {
        int frame;
        double log_gain;
    };
    FrameFormat format_;
    std::vector<float> last_, now_, ratios_;
    std::vector<Step> steps_;
};

}  // namespace verdigris
