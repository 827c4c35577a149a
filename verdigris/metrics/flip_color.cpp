// SPDX-License-Identifier: MIT
#include "verdigris/metrics/flip_color.h"

#include <cmath>
#include <cstddef>

namespace verdigris {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

// Linear sRGB to XYZ from the chromaticities of [BT709], as exact fractions; the white is that of
// equal parts. What FLIP uses; color/convert.h has the four digits that [IEC61966-2-1] prints.
constexpr Matrix kXyz{{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                       {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                       {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};

// [Andersson2020], Section 4.1: the share of the color error's range that is stretched, and what
// it is stretched to.
constexpr double kStretched = 0.4, kStretchedTo = 0.95;

Matrix inverse(const Matrix& m) {
    const auto minor = [&](std::size_t r, std::size_t c) {
        const std::size_t r0 = (r + 1) % 3, r1 = (r + 2) % 3, c0 = (c + 1) % 3, c1 = (c + 2) % 3;
        return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    };
    const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    Matrix out{};
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) out[r][c] = minor(c, r) / det;
    return out;
}

std::array<float, 9> flat(const Matrix& m) {
    std::array<float, 9> out{};
    for (std::size_t i = 0; i < 9; ++i) out[i] = float(m[i / 3][i % 3]);
    return out;
}

/// L, and a and b after Hunt: the more colorful, the lighter. Of relative X, Y, Z.
Vector hunt_lab(const Vector& xyz) {
    constexpr double kDelta = 6.0 / 29;
    Vector f{};
    for (std::size_t i = 0; i < 3; ++i) {
        f[i] = xyz[i] > kDelta * kDelta * kDelta ? std::cbrt(xyz[i])
                                                 : xyz[i] / (3 * kDelta * kDelta) + 4.0 / 29;
    }
    const double l = 116 * f[1] - 16;
    return {l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])};
}

FlipColor make() {
    FlipColor out;
    Matrix relative = kXyz;
    for (Vector& row : relative) {
        const double white = row[0] + row[1] + row[2];
        for (double& v : row) v /= white;
    }
    Matrix opponent{};
    for (std::size_t i = 0; i < 3; ++i) {
        opponent[0][i] = relative[1][i];
        opponent[1][i] = relative[0][i] - relative[1][i];
        opponent[2][i] = relative[1][i] - relative[2][i];
    }
    out.opponent_from_linear = flat(opponent);
    out.linear_from_opponent = flat(inverse(opponent));
    out.relative_xyz_from_linear = flat(relative);

    // The largest error there is: between green and blue, by HyAB.
    const Vector green = hunt_lab({relative[0][1], relative[1][1], relative[2][1]}),
                 blue = hunt_lab({relative[0][2], relative[1][2], relative[2][2]});
    const double largest =
        std::pow(std::abs(green[0] - blue[0]) + std::hypot(green[1] - blue[1], green[2] - blue[2]),
                 kFlipColorPower);
    const double knee = kStretched * largest;
    out.knee = float(knee);
    out.slope = float(kStretchedTo / knee);
    out.at_knee = float(kStretchedTo);
    out.upper_slope = float((1 - kStretchedTo) / (largest - knee));
    return out;
}

}  // namespace

const FlipColor& flip_color() {
    static const FlipColor color = make();
    return color;
}

}  // namespace verdigris
