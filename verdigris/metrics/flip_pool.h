// SPDX-License-Identifier: MIT
// A map of errors as a few numbers (internal).
#pragma once

#include "verdigris/metrics/flip.h"

namespace verdigris {

/// Fills every number of `result` from its map, which is in [0, 1] and not empty. Sums in double,
/// in an order that depends on the size of the map only.
void pool_errors(FlipResult& result);

}  // namespace verdigris
