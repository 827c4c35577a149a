// SPDX-License-Identifier: MIT
#include "verdigris/copper/mixture.h"

#include <fmt/format.h>

#include <cmath>

#include "verdigris/error.h"

namespace verdigris {

std::complex<double> bruggeman_permittivity(std::complex<double> first, std::complex<double> second,
                                            double fraction) {
    if (!(fraction >= 0 && fraction <= 1)) {
        throw Error(ErrorCode::usage,
                    fmt::format("a volume fraction of {}; allowed are 0 to 1", fraction));
    }
    if (fraction == 1) return first;
    if (fraction == 0) return second;
    const std::complex<double> b = (3 * fraction - 1) * first + (2 - 3 * fraction) * second;
    const std::complex<double> root = std::sqrt(b * b + 8.0 * first * second);
    // The two roots multiply to -e1 e2 / 2: of two lossy media exactly one has Im > 0, and of two
    // transparent ones exactly one is positive.
    const std::complex<double> plus = (b + root) / 4.0, minus = (b - root) / 4.0;
    if (plus.imag() != minus.imag()) return plus.imag() > minus.imag() ? plus : minus;
    return plus.real() > minus.real() ? plus : minus;
}

std::complex<double> bruggeman_index(std::complex<double> first, std::complex<double> second,
                                     double fraction) {
    if (fraction == 1) return first;
    if (fraction == 0) return second;
    const std::complex<double> n =
        std::sqrt(bruggeman_permittivity(first * first, second * second, fraction));
    return n.imag() < 0 ? -n : n;
}

}  // namespace verdigris
