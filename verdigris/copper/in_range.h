// SPDX-License-Identifier: MIT
// How this room refuses an option: one sentence with its name and the allowed range.
#pragma once

#include <fmt/format.h>

#include "verdigris/error.h"

namespace verdigris {

/// Throws Error{usage} unless least <= value <= most. NaN is refused.
inline void demand_in_range(double value, double least, double most, const char* name) {
    if (value >= least && value <= most) return;
    throw Error(ErrorCode::usage,
                fmt::format("{} is {}; allowed are {} to {}", name, value, least, most));
}

}  // namespace verdigris
