// SPDX-License-Identifier: MIT
#include "verdigris/material/gaussian.h"

#include <cmath>

namespace verdigris {

std::vector<float> gaussian_taps(double sigma) {
    if (!(sigma > 0)) return {1.0f};
    const int radius = int(std::ceil(3 * sigma));
    std::vector<double> taps;
    double sum = 0;
    for (int i = 0; i <= radius; ++i) {
        taps.push_back(std::exp(-0.5 * (i / sigma) * (i / sigma)));
        sum += i == 0 ? taps.back() : 2 * taps.back();
    }
    std::vector<float> out;
    for (double t : taps) out.push_back(float(t / sum));
    return out;
}

}  // namespace verdigris
