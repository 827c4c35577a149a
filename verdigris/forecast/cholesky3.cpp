// SPDX-License-Identifier: MIT
#include "verdigris/forecast/cholesky3.h"

#include <algorithm>
#include <cmath>

namespace verdigris {
namespace {

double column_norm(const Matrix3& m) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        largest = std::max(largest, std::abs(m[0][c]) + std::abs(m[1][c]) + std::abs(m[2][c]));
    }
    return largest;
}

}  // namespace

Cholesky3::Cholesky3(const Matrix3& a) {
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c <= r; ++c) {
            double rest = a[r][c];
            for (std::size_t k = 0; k < c; ++k) rest -= l_[r][k] * l_[c][k];
            if (r == c && !(rest > 0)) return;
            l_[r][c] = r == c ? std::sqrt(rest) : rest / l_[c][c];
        }
    }
    Matrix3 inverse;  // symmetric, so rows serve as columns
    for (std::size_t c = 0; c < 3; ++c) {
        Triple unit{};
        unit[c] = 1;
        inverse[c] = solve(unit);
    }
    const double product = column_norm(a) * column_norm(inverse);
    rcond_ = std::isfinite(product) && product > 0 ? 1 / product : 0;
}

Triple Cholesky3::solve(const Triple& b) const {
    Triple x = b;
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < r; ++k) x[r] -= l_[r][k] * x[k];
        x[r] /= l_[r][r];
    }
    for (std::size_t r = 3; r-- > 0;) {
        for (std::size_t k = r + 1; k < 3; ++k) x[r] -= l_[k][r] * x[k];
        x[r] /= l_[r][r];
    }
    return x;
}

}  // namespace verdigris
