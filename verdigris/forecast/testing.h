// SPDX-License-Identifier: MIT
// What the tests of this room share: contexts whose truth is known.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "verdigris/forecast/affine.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// A copper-like texture: smooth, colorful, within [0.15, 0.85].
inline SrgbF texture(int x, int y) {
    const double u = x * 0.11, v = y * 0.17;
    return {float(0.60 + 0.15 * std::sin(u) + 0.05 * std::cos(3 * v)),
            float(0.42 + 0.10 * std::cos(v) + 0.06 * std::sin(1.7 * u + v)),
            float(0.33 + 0.12 * std::sin(0.7 * u - 1.3 * v))};
}

inline Image<SrgbF> paint(int width, int height, const std::function<SrgbF(int, int)>& color) {
    Image<SrgbF> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image(x, y) = color(x, y);
    }
    return image;
}

/// Adds independent Gaussian noise to every channel.
inline void add_noise(Image<SrgbF>& image, double sigma, std::mt19937& random) {
    std::normal_distribution<float> noise(0, float(sigma));
    for (SrgbF& c : image.pixels()) {
        c = {c.r + noise(random), c.g + noise(random), c.b + noise(random)};
    }
}

inline SrgbF apply(const AffineDrift& d, SrgbF x0, double t) {
    const auto channel = [&](std::size_t c, float from) {
        return float(double(from) + t * (d.S[c][0] * double(x0.r) + d.S[c][1] * double(x0.g) +
                                         d.S[c][2] * double(x0.b) + d.s[c]));
    };
    return {channel(0, x0.r), channel(1, x0.g), channel(2, x0.b)};
}

/// n frames of x_t = x_0 + t (S x_0 + s): a transform sequence that is linear in time.
inline Context drifting(int n, const AffineDrift& drift, double sigma = 0, unsigned seed = 1,
                        int width = 48, int height = 40) {
    std::mt19937 random(seed);
    Context context;
    for (int t = 0; t < n; ++t) {
        context.frames.push_back(
            paint(width, height, [&](int x, int y) { return apply(drift, texture(x, y), t); }));
        if (sigma > 0) add_noise(context.frames.back(), sigma, random);
    }
    context.sigma = sigma;
    context.tau = std::max(5e-4, 2.4 * sigma);
    return context;
}

/// A gentle drift that mixes channels.
inline AffineDrift planted_drift() {
    return {{{{-0.010, 0.004, 0.002}, {0.003, -0.006, 0.001}, {-0.002, 0.005, 0.004}}},
            {-0.002, 0.001, 0.0015}};
}

inline double largest_difference(const Image<SrgbF>& a, const Image<SrgbF>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        const SrgbF p = a.pixels()[i], q = b.pixels()[i];
        largest =
            std::max({largest, std::abs(double(p.r) - double(q.r)),
                      std::abs(double(p.g) - double(q.g)), std::abs(double(p.b) - double(q.b))});
    }
    return largest;
}

using Scene = std::function<Image<SrgbF>(int)>;  ///< frame t, without noise

/// Its first n frames under noise.
inline Context seen_through_noise(const Scene& scene, int n, Mask specimen, double sigma,
                                  unsigned seed = 1) {
    std::mt19937 random(seed);
    Context c;
    for (int t = 0; t < n; ++t) {
        c.frames.push_back(scene(t));
        add_noise(c.frames.back(), sigma, random);
    }
    c.specimen = std::move(specimen);
    c.sigma = sigma;
    c.tau = 2.4 * sigma;
    return c;
}

inline bool same_bytes(const Image<SrgbF>& a, const Image<SrgbF>& b) {
    return a.same_size(b) && std::memcmp(a.row(0), b.row(0), a.byte_count()) == 0;
}

}  // namespace verdigris
