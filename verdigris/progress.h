// SPDX-License-Identifier: MIT
// How a long computation reports where it is and learns that it should stop. The library never
// prints; the caller draws the bar.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "verdigris/error.h"

namespace verdigris {

/// Called from one thread at a time with a stage name ("decode"), the work done and the total
/// (0 when unknown). Returns false to ask for a stop. An empty function means: run to the end.
using Progress = std::function<bool(std::string_view stage, std::int64_t done, std::int64_t total)>;

/// Reports, and throws Error{interrupted} if the callback asks to stop.
inline void report(const Progress& progress, std::string_view stage, std::int64_t done,
                   std::int64_t total) {
    if (progress && !progress(stage, done, total)) {
        throw Error(ErrorCode::interrupted,
                    "interrupted while working on stage '" + std::string(stage) + "'");
    }
}

}  // namespace verdigris
