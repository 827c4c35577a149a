// SPDX-License-Identifier: MIT
// A recording in memory, as windows are cut from it (internal).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "verdigris/evaluate/foreground.h"
#include "verdigris/evaluate/windows.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/observe/observe.h"
#include "verdigris/progress.h"

namespace verdigris {

/// The usable samples as float: 196 KB each at 128 x 128, 187 MB for 950.
class HeldRecording {
  public:
    HeldRecording(const Observation& observation, SampleRange usable, const Progress& progress);

    const Image<SrgbF>& frame(int sample) const {
        return frames_[std::size_t(sample - usable_.begin)];
    }
    /// Pixels that are clipped, or beside one, in some frame of the window's context: as
    /// context_from() marks them.
    void clipped(const std::vector<int>& samples, int context, Mask& out) const;
    int width() const { return frames_.front().width(); }
    int height() const { return frames_.front().height(); }

  private:
    SampleRange usable_;
    std::vector<Image<SrgbF>> frames_;
    std::vector<Mask> clipped_;  ///< empty where nothing is
};

/// SHA-256 over the floats of each sample in `usable`; streamed, samples in parallel.
std::vector<std::string> frame_hashes(const SampleStore& samples, SampleRange usable,
                                      const Progress& progress);

}  // namespace verdigris
