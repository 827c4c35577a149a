// SPDX-License-Identifier: MIT
// Recordings small enough for a test, whose future is known.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "verdigris/appearance/material_judgment.h"
#include "verdigris/evaluate/testing.h"

namespace verdigris::testing {

/// 24 x 16 pixels, the right half specimen, 10 samples per unit; it darkens and greens steadily.
/// `other` is another specimen.
inline Observation aging(std::string name, int count = 200, double other = 0) {
    return observed(std::move(name), 24, 16, count, [other](int x, int y, int t) {
        SrgbF c = texture(x + int(7 * other), y);
        const float u = float(t) / 10 * (1 + 0.2f * float(other));
        return SrgbF{c.r - 0.008f * u, c.g + 0.002f * u, c.b + 0.003f * u};
    });
}

inline std::vector<Observation> two_agings() {
    std::vector<Observation> list;
    list.push_back(aging("first"));
    list.push_back(aging("second", 200, 1));
    return list;
}

/// What `observation` shows `units` after the last context frame, found by that frame's bytes: no
/// forecaster could, which is the point. `sign` -1 is the mirrored failure: as far, but away.
inline Forecaster oracle(std::vector<const Observation*> observations, int furthest, float sign) {
    return {sign > 0 ? "perfect" : "mirrored", [=](const Context& context) {
                const Image<SrgbF>& last = context.frames.back();
                Forecast out;
                out.stack.base = last.clone();
                out.context_length = context.length();
                for (const Observation* o : observations) {
                    for (int t = 0; t < o->store->count(); ++t) {
                        if (!std::ranges::equal(o->store->image(t).pixels(), last.pixels()))
                            continue;
                        for (int k = 1; k <= furthest; ++k) {
                            Image<SrgbF> frame = o->store->image(t + 10 * k);
                            for (std::size_t i = 0; sign < 0 && i < frame.pixel_count(); ++i) {
                                SrgbF& f = frame.pixels()[i];
                                const SrgbF l = last.pixels()[i];
                                f = {2 * l.r - f.r, 2 * l.g - f.g, 2 * l.b - f.b};
                            }
                            out.stack.horizons.push_back(k);
                            out.stack.frames.push_back(std::move(frame));
                        }
                        return out;
                    }
                }
                return out;
            }};
}

inline EvaluationProtocol aging_protocol(int windows = 3) {
    EvaluationProtocol p = short_recording_protocol(10);
    p.max_windows = windows;
    p.bootstrap_draws = 200;
    return p;
}

inline MaterialJudgeOptions small_options() {
    MaterialJudgeOptions o;
    o.horizons = {2, 8};
    o.view.size = 48;
    o.view.samples = 8;
    o.no_lpips = "not in a test";
    return o;
}

}  // namespace verdigris::testing
