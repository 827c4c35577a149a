// SPDX-License-Identifier: MIT
#include "verdigris/simulate/random.h"

#include <cstddef>

namespace verdigris {

std::vector<double> ornstein_uhlenbeck(const Random& random, int count, double step,
                                       double correlation) {
    const double keep = std::exp(-step / correlation);
    const double fresh = std::sqrt(-std::expm1(-2 * step / correlation));
    std::vector<double> values(std::size_t(count), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double n = random.gaussian(i);
        values[i] = i == 0 ? n : keep * values[i - 1] + fresh * n;
    }
    return values;
}

}  // namespace verdigris
