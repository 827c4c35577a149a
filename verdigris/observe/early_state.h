// SPDX-License-Identifier: MIT
// What the specimen looked like when the recording began.
#pragma once

#include "verdigris/observe/observe.h"

namespace verdigris {

/// Per pixel and channel median of the first `samples` kept samples (all, if fewer), so that one
/// bad frame at the start does not count. chosen: 3 is the fewest that outvotes one.
Image<SrgbF> early_state(const Observation& observation, int samples = 3);

}  // namespace verdigris
