// SPDX-License-Identifier: MIT
// What the tests of this room share: recordings whose truth is known.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "verdigris/observe/noise.h"
#include "verdigris/observe/observe.h"
#include "verdigris/observe/testing/drifting_store.h"

namespace verdigris::testing {

using PixelStore = FunctionStore;

/// Numbers that depend on nothing but their argument: standard normal, by Box and Muller's method
/// on splitmix64.
inline double normal(std::uint64_t key) {
    const auto uniform = [](std::uint64_t k) {
        k += 0x9E3779B97F4A7C15ull;
        k = (k ^ (k >> 30)) * 0xBF58476D1CE4E5B9ull;
        k = (k ^ (k >> 27)) * 0x94D049BB133111EBull;
        return (double((k ^ (k >> 31)) >> 11) + 0.5) * 0x1p-53;
    };
    return std::sqrt(-2 * std::log(uniform(2 * key))) *
           std::cos(6.283185307179586 * uniform(2 * key + 1));
}

/// A copper-like texture, smooth and colorful, within [0.2, 0.8].
inline SrgbF texture(int x, int y) {
    const double u = x * 0.31, v = y * 0.47;
    return {float(0.60 + 0.12 * std::sin(u) + 0.05 * std::cos(3 * v)),
            float(0.42 + 0.10 * std::cos(v) + 0.06 * std::sin(1.7 * u + v)),
            float(0.33 + 0.10 * std::sin(0.7 * u - 1.3 * v))};
}

/// The right half of the frame is specimen.
inline Observation observed(std::string name, int width, int height, int count,
                            PixelStore::Pixel pixel, double sigma = 0) {
    Observation o;
    o.source_name = name;
    o.source_sha256 = "of " + name;
    o.axis = {double(count) / 10, count, 10, 1};
    o.samples.resize(std::size_t(count));
    o.store = std::make_shared<PixelStore>(width, height, count, std::move(pixel));
    o.specimen = Mask(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = width / 2; x < width; ++x) o.specimen(x, y) = kInside;
    }
    o.noise = noise_from(sigma, std::nullopt);
    return o;
}

/// x_t = x_0 + t/stride * (S x_0 + s), with a gentle drift that mixes channels; plus noise.
inline SrgbF drifted(int x, int y, double units, double speed = 1) {
    const SrgbF c = texture(x, y);
    const double r = double(c.r), g = double(c.g), b = double(c.b), t = units * speed;
    return {float(r + t * (-0.0030 * r + 0.0012 * g + 0.0006 * b - 0.0006)),
            float(g + t * (0.0009 * r - 0.0018 * g + 0.0003 * b + 0.0003)),
            float(b + t * (-0.0006 * r + 0.0015 * g + 0.0012 * b + 0.0005))};
}

inline Observation affine_recording(std::string name, int count, double sigma = 0, double speed = 1,
                                    std::uint64_t seed = 1) {
    return observed(
        std::move(name), 24, 16, count,
        [=](int x, int y, int t) {
            SrgbF c = drifted(x, y, t / 10.0 + double(seed), speed);
            if (sigma > 0) {
                const std::uint64_t key =
                    ((seed * 4096 + std::uint64_t(t)) * 64 + std::uint64_t(y)) * 64 +
                    std::uint64_t(x);
                c.r += float(sigma * normal(3 * key));
                c.g += float(sigma * normal(3 * key + 1));
                c.b += float(sigma * normal(3 * key + 2));
            }
            return c;
        },
        sigma);
}

}  // namespace verdigris::testing
