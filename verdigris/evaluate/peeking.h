// SPDX-License-Identifier: MIT
// Does a forecaster look beyond its context? It gets a Context and nothing else, but it may hold on
// to the observation, or remember earlier contexts. So: replace everything but the context by
// something else, and see whether the forecast changes.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "verdigris/evaluate/protocol.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/observe/observe.h"
#include "verdigris/status.h"

namespace verdigris {

/// Samples that can be scrambled behind a reader's back. Put it into an observation before anybody
/// gets hold of that: whoever reads samples through it later is seen.
class ScrambledSamples final : public SampleStore {
  public:
    explicit ScrambledSamples(std::shared_ptr<const SampleStore> samples);

    /// From now on only `kept` (sample indices) read as they are; every other one has its colors
    /// inverted and is turned upside down. Empty: every one reads as it is.
    void keep_only(std::optional<std::vector<int>> kept);

    int count() const override { return samples_->count(); }
    int width() const override { return samples_->width(); }
    int height() const override { return samples_->height(); }
    Image<SrgbF> image(int index) const override;

  private:
    std::shared_ptr<const SampleStore> samples_;
    mutable std::mutex mutex_;
    std::optional<std::vector<int>> kept_;
};

/// Forecasts the windows at `starts` (valid ones, sample indices) with all samples in place, again,
/// and with everything outside of the context scrambled; compares the bytes of all horizons.
/// Findings, refusals: "looks_beyond_context"; "forecast_not_repeatable" where the first two
/// differ already, so that nothing can be said. `samples` is the store of `observation`.
/// What a forecaster learned before the observation was made scrambled cannot be seen this way.
Statuses check_peeking(const EvaluationProtocol& protocol, const Observation& observation,
                       ScrambledSamples& samples, const Forecaster& forecaster,
                       std::span<const int> starts);

}  // namespace verdigris
