// SPDX-License-Identifier: MIT
// Pictures for the tests of this room.
#pragma once

#include <cstdint>
#include <functional>
#include <random>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris::testing {

inline Image<SrgbF> picture(int width, int height, const std::function<SrgbF(int, int)>& color) {
    Image<SrgbF> image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image(x, y) = color(x, y);
    return image;
}

inline Image<SrgbF> flat(int width, int height, SrgbF color) {
    return picture(width, height, [&](int, int) { return color; });
}

/// Independent values in [0, 1]; the same for a seed everywhere.
inline Image<SrgbF> noise(int width, int height, std::uint32_t seed) {
    std::mt19937 bits(seed);
    const auto next = [&] { return float(bits() >> 8) * 0x1p-24f; };
    return picture(width, height, [&](int, int) {
        const float r = next(), g = next();
        return SrgbF{r, g, next()};
    });
}

}  // namespace verdigris::testing
