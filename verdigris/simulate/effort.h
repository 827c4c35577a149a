// SPDX-License-Identifier: MIT
// What a simulation will cost, before it starts: keys within their ranges can still ask together
// for days.
#pragma once

#include <string>

#include "verdigris/simulate/spec.h"

namespace verdigris {

struct Effort {
    double hours = 0;      ///< of one core, encoding a video included; right to a factor of about 3
    double gigabytes = 0;  ///< of memory
    std::string mostly;    ///< the keys that make most of the hours
};
Effort estimated_effort(const SimulationSpec& spec);

}  // namespace verdigris
