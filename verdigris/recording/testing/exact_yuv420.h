// SPDX-License-Identifier: MIT
// yuv420_from_srgb's formulas once more, in double and pixel by pixel, for tests and the bench.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris::testing {

/// Codes before rounding: Y, Cb, Cr.
struct ExactYuv420 {
    explicit ExactYuv420(ImageView<const SrgbU8> image)
        : width(image.width()), height(image.height()) {
        for (int c = 0; c < 3; ++c) {
            const int step = c ? 2 : 1;
            for (int y = 0; y < height; y += step) {
                for (int x = 0; x < width; x += step) {
                    plane[std::size_t(c)].push_back(c ? chroma(image, c, x, y)
                                                      : code(image(x, y), 0));
                }
            }
        }
    }
    /// The largest and the mean distance of `codes` (rows `stride` apart) from the exact ones.
    struct Distance {
        double most = 0, mean = 0;
    };
    Distance distance(int component, const std::uint8_t* codes, std::ptrdiff_t stride) const {
        const std::vector<double>& exact = plane[std::size_t(component)];
        const int columns = component ? width / 2 : width;
        Distance out;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            const int x = int(i) % columns, y = int(i) / columns;
            const double off = std::abs(codes[y * stride + x] - exact[i]);
            out.most = std::max(out.most, off);
            out.mean += off / double(exact.size());
        }
        return out;
    }

    int width, height;
    std::array<std::vector<double>, 3> plane;

  private:
    static double code(SrgbU8 p, int component) {
        const double r = p.r / 255.0, g = p.g / 255.0, b = p.b / 255.0;
        const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        if (component == 0) return 16 + 219 * y;
        return 128 + 224 * (component == 1 ? (b - y) / 1.8556 : (r - y) / 1.5748);
    }
    static double chroma(ImageView<const SrgbU8> image, int component, int x, int y) {
        double sum = 0;
        for (int dx = -1; dx <= 1; ++dx) {
            const int column = std::max(x + dx, 0);
            for (int dy = 0; dy <= 1; ++dy) {
                sum += (dx == 0 ? 2 : 1) * code(image(column, y + dy), component);
            }
        }
        return sum / 8;
    }
};

}  // namespace verdigris::testing
