// SPDX-License-Identifier: MIT
// Does a forecaster say the same of the same window after it has seen the others? (internal)
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "verdigris/evaluate/scores.h"
#include "verdigris/evaluate/window_scorer.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/status.h"

namespace verdigris {

inline bool same_forecast(const Forecast& a, const Forecast& b, int horizons) {
    for (int k = 1; k <= horizons; ++k) {
        const Image<SrgbF> p = a.at(k), q = b.at(k);
        if (!p.same_size(q) || !std::ranges::equal(p.pixels(), q.pixels())) return false;
    }
    return true;
}

/// Forecasts of one window before and after all others, which contain its future.
class RepeatCheck {
  public:
    RepeatCheck(const EvaluationProtocol& protocol, const WindowScorer& scorer, int start,
                const std::vector<Forecaster>& forecasters)
        : protocol_(protocol), scorer_(scorer), start_(start), forecasters_(forecasters) {
        first_ = forecast();
    }
    void finish(const Direction& direction, Statuses& notes) {
        const std::vector<Forecast> second = forecast();
        for (std::size_t i = 0; i < second.size(); ++i) {
            if (same_forecast(first_[i], second[i], protocol_.horizons)) continue;
            notes.push_back(
                {"forecast_not_repeatable", Severity::refusal,
                 fmt::format("{} forecasts the first window of {} differently after it has seen "
                             "the others: it remembers, or it is random",
                             direction.entrants[i].name, direction.held_out)});
        }
    }

  private:
    std::vector<Forecast> forecast() const {
        WindowScratch scratch;
        scorer_.context_of(start_, scratch);
        std::vector<Forecast> out;
        for (const Forecaster& f : forecasters_) out.push_back(f.forecast(scratch.context));
        return out;
    }
    const EvaluationProtocol& protocol_;
    const WindowScorer& scorer_;
    int start_;
    const std::vector<Forecaster>& forecasters_;
    std::vector<Forecast> first_;
};

}  // namespace verdigris
