// SPDX-License-Identifier: MIT
#include "verdigris/observe/with_samples.h"

#include <utility>

namespace verdigris {

Observation with_samples(const Observation& observation,
                         std::shared_ptr<const SampleStore> samples) {
    Observation out;
    out.source_name = observation.source_name;
    out.source_sha256 = observation.source_sha256;
    out.axis = observation.axis;
    out.samples = observation.samples;
    out.store = std::move(samples);
    out.specimen = observation.specimen.clone();
    out.clipped = observation.clipped.clone();
    out.noise = observation.noise;
    out.crop = observation.crop;
    out.decode = observation.decode;
    out.notes = observation.notes;
    return out;
}

}  // namespace verdigris
