// SPDX-License-Identifier: MIT
// Small recordings that change, for tests that train.
#pragma once

#include <string>

#include "verdigris/evaluate/evaluate.h"
#include "verdigris/evaluate/testing.h"
#include "verdigris/files/testing.h"

namespace verdigris::testing {

/// `count` samples of size x size pixels whose left half stands still and whose right half drifts,
/// faster in the middle of it.
inline Observation changing_recording(int size, int count, std::string name = "plate") {
    return observed(
        std::move(name), size, size, count,
        [size](int x, int y, int t) {
            SrgbF c = texture(x, y);
            if (2 * x < size) return c;
            const double units = t / 10.0;
            const double pace = 0.01 * (1 + std::sin(3.1 * y / size));
            c.r -= float(pace * units), c.g += float(0.4 * pace * units);
            c.b += float(0.7 * pace * units);
            return c;
        },
        1e-4);
}

/// The protocol for it: every sample counts, n = 3 and K = 4 unless said.
inline EvaluationProtocol small_protocol(int context = 3, int horizons = 4) {
    EvaluationProtocol protocol = short_recording_protocol(2);
    protocol.context = context;
    protocol.horizons = horizons;
    return protocol;
}

inline TrainingSource source_of(const Observation& observation,
                                const EvaluationProtocol& protocol) {
    const WindowPlan plan = plan_windows(protocol, observation.store->count());
    return {observation.source_name, &observation, plan.splits->train, plan.splits->validation};
}

}  // namespace verdigris::testing
