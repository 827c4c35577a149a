// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/coverage.h"

#include <array>
#include <cmath>
#include <limits>

namespace verdigris {

Coverage coverage_of(const Spread& spread, double h, const Image<SrgbF>& frame,
                     const Image<SrgbF>& truth, const PixelWeights& area, Image<SrgbF>& scratch) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Coverage out{nan, nan, nan, nan};
    if (!spread.known() || !spread.own.same_size(frame)) return out;
    spread_image(spread, h, scratch);
    std::array<double, 3> error{};
    double inside80 = 0, inside95 = 0, pixels = 0;
    for (std::size_t i = 0; i < frame.pixel_count(); ++i) {
        const SrgbF s = scratch.pixels()[i];
        if (area.weight[i] == 0 || !(s.r + s.g + s.b > 0)) continue;
        const SrgbF f = frame.pixels()[i], t = truth.pixels()[i];
        const std::array<double, 3> off{double(t.r - f.r), double(t.g - f.g), double(t.b - f.b)};
        const std::array<double, 3> sd{double(s.r), double(s.g), double(s.b)};
        for (std::size_t c = 0; c < 3; ++c) {
            inside80 += std::abs(off[c]) <= kHalfWidth80 * sd[c];
            inside95 += std::abs(off[c]) <= kHalfWidth95 * sd[c];
            error[c] += off[c];
        }
        ++pixels;
    }
    if (pixels == 0) return out;
    const SrgbF of_mean = spread_of_mean(spread, h);
    const std::array<double, 3> sd{double(of_mean.r), double(of_mean.g), double(of_mean.b)};
    out = {inside80 / (3 * pixels), inside95 / (3 * pixels), 0, 0};
    for (std::size_t c = 0; c < 3; ++c) {
        out.mean80 += (std::abs(error[c] / pixels) <= kMeanHalfWidth80 * sd[c]) / 3.0;
        out.mean95 += (std::abs(error[c] / pixels) <= kMeanHalfWidth95 * sd[c]) / 3.0;
    }
    return out;
}

}  // namespace verdigris
