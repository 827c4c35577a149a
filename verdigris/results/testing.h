// SPDX-License-Identifier: MIT
// An evaluation small enough for a test.
#pragma once

#include <vector>

#include "verdigris/evaluate/characterize.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/evaluate/testing.h"

namespace verdigris::testing {

/// Two recordings with a planted affine drift and a little noise, persistence and affinergb.
inline Evaluation small_evaluation() {
    EvaluationProtocol p = short_recording_protocol(10);
    p.horizons = 4;
    p.bootstrap_draws = 200;
    std::vector<Observation> list;
    for (const int which : {1, 2}) {
        list.push_back(observed(
            which == 1 ? "first" : "second", 24, 16, 600,
            [which](int x, int y, int t) {
                SrgbF c = drifted(x, y, t / 10.0, which == 1 ? 1 : 0.8);
                const auto key = std::uint64_t(((t * 16 + y) * 24 + x) * 3 + which * 1000003);
                c.r += float(2e-5 * normal(key));
                c.g += float(2e-5 * normal(key + 1));
                c.b += float(2e-5 * normal(key + 2));
                return c;
            },
            2e-5));
    }
    Entrant affine = training_free(affinergb(paper_affine()));
    affine.name = "affinergb";
    return evaluate(p, list, {affine});
}

}  // namespace verdigris::testing
