// SPDX-License-Identifier: MIT
// What the tests of this room share: contexts, forecasts and recipes whose maps are known.
#pragma once

#include <functional>
#include <random>

#include "verdigris/forecast/forecast.h"
#include "verdigris/material/material.h"

namespace verdigris {

inline Image<SrgbF> paint(int width, int height, const std::function<SrgbF(int, int)>& color) {
    Image<SrgbF> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image(x, y) = color(x, y);
    }
    return image;
}

inline Image<SrgbF> flat(int width, int height, SrgbF c) {
    return paint(width, height, [c](int, int) { return c; });
}

/// Copper with texture, noise and a slow drift, in a frame with a backdrop and a glint.
inline Context copper_context(int width, int height, int n, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0, 0.004f);
    Context context;
    for (int t = 0; t < n; ++t) {
        context.frames.push_back(paint(width, height, [&](int x, int y) {
            const float u = float(std::sin(x * 0.31) * std::cos(y * 0.23));
            return SrgbF{0.60f + 0.1f * u - 0.01f * float(t) + noise(random),
                         0.42f + 0.1f * u + 0.006f * float(t) + noise(random),
                         0.33f + 0.08f * u + 0.008f * float(t) + noise(random)};
        }));
    }
    context.specimen = Mask(width, height);
    context.clipped = Mask(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (x >= 2 && x < width - 2) context.specimen(x, y) = kInside;
            if (x >= width / 3 && x < width / 3 + 4) {
                context.clipped(x, y) = kInside;
                for (auto& f : context.frames) f(x, y) = {1, 1, 1};
            }
        }
    }
    context.sigma = 0.004;
    context.tau = 0.0096;
    return context;
}

/// base + h rate, with the rate 0 outside the specimen and under the glint.
inline Forecast straight_forecast(const Context& context, SrgbF rate) {
    Forecast forecast;
    const Image<SrgbF>& last = context.frames.back();
    forecast.trajectory.base = last.clone();
    forecast.trajectory.rate = paint(last.width(), last.height(), [&](int x, int y) {
        const bool moves = (context.specimen.empty() || context.specimen(x, y)) &&
                           (context.clipped.empty() || !context.clipped(x, y));
        return moves ? rate : SrgbF{};
    });
    forecast.trajectory.law = {1, context.length()};
    forecast.context_length = context.length();
    return forecast;
}

}  // namespace verdigris
