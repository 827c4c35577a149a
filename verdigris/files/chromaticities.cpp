// SPDX-License-Identifier: MIT
#include "verdigris/files/chromaticities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace verdigris {
namespace {

using Vector = std::array<double, 3>;

Vector multiply(const Matrix3& m, const Vector& v) {
    Vector out{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) out[r] += m[r][c] * v[c];
    }
    return out;
}

Matrix3 multiply(const Matrix3& a, const Matrix3& b) {
    Matrix3 out{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t k = 0; k < 3; ++k) out[r][c] += a[r][k] * b[k][c];
        }
    }
    return out;
}

double minor(const Matrix3& m, std::size_t r, std::size_t c) {
    const std::size_t r0 = (r + 1) % 3, r1 = (r + 2) % 3, c0 = (c + 1) % 3, c1 = (c + 2) % 3;
    return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
}

double determinant(const Matrix3& m) {
    return m[0][0] * minor(m, 0, 0) + m[0][1] * minor(m, 0, 1) + m[0][2] * minor(m, 0, 2);
}

Matrix3 inverse(const Matrix3& m) {
    Matrix3 out{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) out[c][r] = minor(m, r, c) / determinant(m);
    }
    return out;
}

Vector xyz_from_xy(const std::array<double, 2>& xy) {
    return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]};
}

// Columns: the XYZ of each primary at luminance 1.
Matrix3 primaries(const Chromaticities& c) {
    Matrix3 m{};
    const Vector columns[] = {xyz_from_xy(c.red), xyz_from_xy(c.green), xyz_from_xy(c.blue)};
    for (std::size_t r = 0; r < 3; ++r) m[r] = {columns[0][r], columns[1][r], columns[2][r]};
    return m;
}

// Scaled so that (1, 1, 1) is the white.
Matrix3 xyz_from_rgb(const Chromaticities& c) {
    Matrix3 m = primaries(c);
    const Vector scale = multiply(inverse(m), xyz_from_xy(c.white));
    for (auto& row : m) {
        for (std::size_t i = 0; i < 3; ++i) row[i] *= scale[i];
    }
    return m;
}

// The cone responses of the Bradford transform [Lam1985], as [Lindbloom] prints them.
constexpr Matrix3 kBradford{
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

Matrix3 adaptation(const std::array<double, 2>& from, const std::array<double, 2>& to) {
    const Vector a = multiply(kBradford, xyz_from_xy(from));
    const Vector b = multiply(kBradford, xyz_from_xy(to));
    Matrix3 scale{};
    for (std::size_t i = 0; i < 3; ++i) scale[i][i] = b[i] / a[i];
    return multiply(inverse(kBradford), multiply(scale, kBradford));
}

struct Named {
    const char* name;
    Chromaticities value;
};
// [ACES], [BT2020], [SMPTE-EG432]; the first is [IEC61966-2-1].
const Named kNamed[] = {
    {"sRGB", {}},
    {"ACEScg", {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}}},
    {"ACES2065-1", {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}, {0.32168, 0.33767}}},
    {"Rec.2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}}},
    {"Display P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}}},
};

bool same(const Chromaticities& a, const Chromaticities& b) {
    // chosen: half of the fourth digit in which they are published, times two for float rounding.
    const auto near = [](const std::array<double, 2>& p, const std::array<double, 2>& q) {
        return std::abs(p[0] - q[0]) < 1e-4 && std::abs(p[1] - q[1]) < 1e-4;
    };
    return near(a.red, b.red) && near(a.green, b.green) && near(a.blue, b.blue) &&
           near(a.white, b.white);
}

}  // namespace

std::string chromaticities_name(const Chromaticities& from) {
    for (const Named& named : kNamed) {
        if (same(named.value, from)) return named.name;
    }
    return "custom";
}

bool is_srgb_primaries(const Chromaticities& from) {
    return same(from, Chromaticities());
}

bool is_usable(const Chromaticities& from) {
    for (const auto& xy : {from.red, from.green, from.blue, from.white}) {
        // Beyond this no primary of a real or virtual RGB space lies; y = 0 has no luminance.
        if (!(std::abs(xy[0]) < 2 && std::abs(xy[1]) < 2 && std::abs(xy[1]) > 1e-3)) return false;
    }
    if (from.white[1] < 0.05 || !(std::abs(determinant(primaries(from))) > 1e-6)) return false;
    const Matrix3 m = linear_from_chromaticities(from);
    return std::all_of(m.begin(), m.end(), [](const Vector& row) {
        return std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); });
    });
}

Matrix3 linear_from_chromaticities(const Chromaticities& from) {
    const Chromaticities srgb;
    return multiply(inverse(xyz_from_rgb(srgb)),
                    multiply(adaptation(from.white, srgb.white), xyz_from_rgb(from)));
}

LinearF multiply(const Matrix3& m, LinearF c) {
    const Vector v = multiply(m, Vector{c.r, c.g, c.b});
    return {float(v[0]), float(v[1]), float(v[2])};
}

}  // namespace verdigris
