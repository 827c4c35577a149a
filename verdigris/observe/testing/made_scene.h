// SPDX-License-Identifier: MIT
// A recording whose truth is known: a copper plate that darkens before a neutral backdrop. For the
// tests of this room.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "verdigris/color/convert.h"
#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris::testing {

/// Numbers that depend on nothing but their arguments (splitmix64).
inline double uniform(std::uint64_t key) {
    key += 0x9E3779B97F4A7C15ull;
    key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9ull;
    key = (key ^ (key >> 27)) * 0x94D049BB133111EBull;
    return double((key ^ (key >> 31)) >> 11) * 0x1p-53;
}
inline double gaussian(std::uint64_t key) {
    const double u = std::max(uniform(2 * key), 1e-12), v = uniform(2 * key + 1);
    return std::sqrt(-2 * std::log(u)) * std::cos(6.283185307179586 * v);
}

struct MadeScene {
    int width = 320, height = 240;
    double center_x = 150, center_y = 125, plate_width = 120, plate_height = 90;
    double tilt_degrees = 0;
    double noise = 2.0 / 255;       ///< standard deviation per pixel and channel
    double darkening = 0.35;        ///< share of the plate's light lost from first to last frame
    double illumination_drift = 0;  ///< +-, one period over the recording
    bool glint = false;             ///< a white spot that crosses the plate
    double backdrop = 0.45, gradient = 0.1;

    bool on_plate(double x, double y) const {
        const double a = tilt_degrees * 3.14159265358979 / 180;
        const double dx = x - center_x, dy = y - center_y;
        const double u = dx * std::cos(a) + dy * std::sin(a);
        const double v = -dx * std::sin(a) + dy * std::cos(a);
        return std::fabs(u) <= 0.5 * plate_width && std::fabs(v) <= 0.5 * plate_height;
    }
    Mask truth() const {
        Mask mask(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) mask(x, y) = on_plate(x, y) ? kInside : 0;
        }
        return mask;
    }
    /// At `progress` 0..1 through the recording; `frame` seeds the noise. Encoded, not clamped.
    SrgbF ideal(int x, int y, double progress) const {
        const double light = 1 + illumination_drift * std::sin(6.283185307179586 * progress);
        double c[3];
        if (on_plate(x, y)) {
            const double texture =
                1 + 0.05 * gaussian(std::uint64_t(y) * 100003 + std::uint64_t(x));
            const double rate =
                0.6 + 0.8 * uniform(std::uint64_t(x / 8) * 977 + std::uint64_t(y / 8));
            const double left = 1 - darkening * progress * rate;
            c[0] = 0.72 * texture * left;
            c[1] = 0.45 * texture * left;
            c[2] = 0.34 * texture * (0.5 + 0.5 * left);
            const double gx = center_x - 0.4 * plate_width + 0.8 * plate_width * progress;
            if (glint && std::hypot(x - gx, y - center_y) < 6) c[0] = c[1] = c[2] = 1.2;
        } else {
            c[0] = c[1] = c[2] = backdrop + gradient * (double(x) / width - 0.5);
        }
        return {float(c[0] * light), float(c[1] * light), float(c[2] * light)};
    }
    Image<SrgbU8> frame(int index, int frames) const {
        auto out = Image<SrgbU8>::for_overwrite(width, height);
        const double progress = frames > 1 ? double(index) / (frames - 1) : 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                SrgbF c = ideal(x, y, progress);
                const std::uint64_t key =
                    ((std::uint64_t(index) * 4096 + std::uint64_t(y)) * 4096 + std::uint64_t(x)) *
                    3;
                c.r += float(noise * gaussian(key));
                c.g += float(noise * gaussian(key + 1));
                c.b += float(noise * gaussian(key + 2));
                out(x, y) = u8_from_srgb(c);
            }
        }
        return out;
    }
};

/// Intersection over union of two masks.
inline double overlap(const Mask& a, const Mask& b) {
    double both = 0, any = 0;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        const bool p = a.pixels()[i] == kInside, q = b.pixels()[i] == kInside;
        both += p && q;
        any += p || q;
    }
    return any > 0 ? both / any : 1;
}

}  // namespace verdigris::testing
