// SPDX-License-Identifier: MIT
// The same observation over other samples: corrected, watched, scrambled.
#pragma once

#include <memory>

#include "verdigris/observe/observe.h"

namespace verdigris {

/// A copy of everything but the samples; `samples` take their place. As many as there were, or the
/// axis no longer fits.
Observation with_samples(const Observation& observation,
                         std::shared_ptr<const SampleStore> samples);

}  // namespace verdigris
