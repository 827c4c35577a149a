// SPDX-License-Identifier: MIT
// How long a stage of a computation will still take.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace verdigris::cli {

/// Stages may take turns ("train", "validate", "train" ...) and may begin in the middle (a run that
/// goes on). A stage that goes back, or has another total, has begun anew.
class StageClock {
  public:
    /// Seconds until `done` is `total`, at the pace since the stage began, all that came in between
    /// included. nullopt: nothing of it was done yet while we looked, or the total is unknown (0).
    /// `now`: seconds of a clock that does not go back.
    std::optional<double> remaining(std::string_view stage, std::int64_t done, std::int64_t total,
                                    double now);

  private:
    struct Stage {
        double start;
        std::int64_t first, last, total;
    };
    std::map<std::string, Stage, std::less<>> stages_;
};

}  // namespace verdigris::cli
