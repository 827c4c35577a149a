// SPDX-License-Identifier: MIT
// One window: its context to every forecaster, their forecasts against its truth (internal).
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "verdigris/evaluate/delta_e_planes.h"
#include "verdigris/evaluate/foreground.h"
#include "verdigris/evaluate/held_recording.h"
#include "verdigris/evaluate/protocol.h"
#include "verdigris/evaluate/scores.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// What one thread needs for one window; kept between windows, so that nothing is allocated.
struct WindowScratch {
    Context context;
    Image<SrgbF> canvas, prediction, spread;
    std::vector<float> sort;
    std::vector<PixelWeights> foreground;
    std::vector<LabPlanes> truth_lab;
    LabPlanes lab;
    bool keep_forecasts = false;        ///< set it before score()
    std::vector<Forecast> forecasts{};  ///< of the last window, in their order, if kept
};

/// Not one per thread: a thread that waits inside a forecaster may begin another window meanwhile.
class ScratchPool {
  public:
    WindowScratch take();
    void give(WindowScratch scratch);

  private:
    std::mutex mutex_;
    std::vector<WindowScratch> free_;
};

class WindowScorer {
  public:
    /// All arguments outlive the scorer.
    WindowScorer(const EvaluationProtocol& protocol, const Observation& observation,
                 const HeldRecording& held, double tau);

    /// The context of the window that starts at sample `start`, into scratch.context.
    void context_of(int start, WindowScratch& scratch) const;
    /// Scores `forecasters`, persistence first, into row `row` of their tables. Returns the
    /// foreground's pixels, the least of its masks; if below the protocol's minimum, nothing else
    /// was done.
    std::int64_t score(int start, int row, const std::vector<Forecaster>& forecasters,
                       std::vector<EntrantScores>& scores, WindowScratch& scratch) const;
    std::int64_t specimen_pixels() const { return specimen_.count; }
    /// The true frame k + 1 units after the context.
    const Image<SrgbF>& truth(int start, int k) const;

  private:
    void score_one(const Forecast& forecast, int start, int row, EntrantScores& scores,
                   WindowScratch& scratch) const;

    const EvaluationProtocol& protocol_;
    const Observation& observation_;
    const HeldRecording& held_;
    double tau_;
    PixelWeights specimen_, area_;
    Mask area_mask_;  ///< empty: every pixel
    std::vector<std::uint32_t> specimen_indices_;
};

}  // namespace verdigris
