// SPDX-License-Identifier: MIT
#include "stage_clock.h"

namespace verdigris::cli {

std::optional<double> StageClock::remaining(std::string_view stage, std::int64_t done,
                                            std::int64_t total, double now) {
    auto at = stages_.find(stage);
    if (at == stages_.end() || done < at->second.last || total != at->second.total)
        at = stages_.insert_or_assign(std::string(stage), Stage{now, done, done, total}).first;
    Stage& s = at->second;
    s.last = done;
    if (done <= s.first || total <= 0) return std::nullopt;
    return (now - s.start) / double(done - s.first) * double(total - done);
}

}  // namespace verdigris::cli
