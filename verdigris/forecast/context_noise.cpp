// SPDX-License-Identifier: MIT
#include "verdigris/forecast/context_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "verdigris/forecast/context_pixels.h"

namespace verdigris {
namespace {

// chosen: the median of 4096 residual variances is known to about 1 %, far better than lambda
// needs (a tenfold ridge changes the result less than the choice of pixels does).
constexpr std::int64_t kSampledPixels = 4096;

}  // namespace

double context_noise(std::span<const Image<SrgbF>> frames, const Mask& where, double fallback) {
    const std::size_t n = frames.size();
    if (n < 4) return fallback;
    const std::vector<std::size_t> sampled = sample_inside(where, kSampledPixels);
    if (sampled.empty()) return fallback;

    std::vector<std::array<double, 3>> mean(n, {0, 0, 0});
    for (std::size_t i = 0; i < n; ++i) {
        const auto pixels = frames[i].pixels();
        for (std::size_t p : sampled) {
            mean[i][0] += double(pixels[p].r);
            mean[i][1] += double(pixels[p].g);
            mean[i][2] += double(pixels[p].b);
        }
        for (double& m : mean[i]) m /= double(sampled.size());
    }

    // About a line the sum of squares of y is Syy - (sum u y)^2 / Suu, u counted from the middle.
    const double center = double(n - 1) / 2;
    double suu = 0;
    for (std::size_t i = 0; i < n; ++i) suu += (double(i) - center) * (double(i) - center);
    std::vector<double> variance;
    variance.reserve(sampled.size());
    for (std::size_t p : sampled) {
        std::array<double, 3> sum{}, square{}, slope{};
        for (std::size_t i = 0; i < n; ++i) {
            const SrgbF c = frames[i].pixels()[p];
            const double u = double(i) - center;
            const std::array<double, 3> y{double(c.r) - mean[i][0], double(c.g) - mean[i][1],
                                          double(c.b) - mean[i][2]};
            for (std::size_t k = 0; k < 3; ++k) {
                sum[k] += y[k];
                square[k] += y[k] * y[k];
                slope[k] += u * y[k];
            }
        }
        double total = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            total += square[k] - sum[k] * sum[k] / double(n) - slope[k] * slope[k] / suu;
        }
        variance.push_back(std::max(total, 0.0) / (3 * double(n - 2)));
    }
    const auto middle = variance.begin() + std::ptrdiff_t(variance.size() / 2);
    std::nth_element(variance.begin(), middle, variance.end());
    // The median of chi^2 with k degrees of freedom is below its mean k: by (1 - 2 / (9 k))^3,
    // 7 % of the variance at n = 5 [WilsonHilferty1931].
    const double bias = 1 - 2 / (9 * 3 * double(n - 2));
    return std::sqrt(*middle / (bias * bias * bias));
}

}  // namespace verdigris
