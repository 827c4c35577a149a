// SPDX-License-Identifier: MIT
// How a node of a GLB moves what is in it (internal).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "verdigris/pixels/image.h"

namespace verdigris {

/// Columns.
struct Matrix3 {
    std::array<Vec3F, 3> column{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Vec3F operator*(Vec3F v) const {
        return {column[0].x * v.x + column[1].x * v.y + column[2].x * v.z,
                column[0].y * v.x + column[1].y * v.y + column[2].y * v.z,
                column[0].z * v.x + column[1].z * v.y + column[2].z * v.z};
    }
    static Vec3F product(Vec3F a, Vec3F b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    float determinant() const {
        const Vec3F c = product(column[0], column[1]);
        return c.x * column[2].x + c.y * column[2].y + c.z * column[2].z;
    }
    /// The inverse transposed, times the determinant: turns normals. Mirrored ones point out again.
    Matrix3 cofactors() const {
        Matrix3 m{{{product(column[1], column[2]), product(column[2], column[0]),
                    product(column[0], column[1])}}};
        if (determinant() < 0) {
            for (Vec3F& c : m.column) c = {-c.x, -c.y, -c.z};
        }
        return m;
    }
};

struct Matrix4 {
    Matrix3 turn;
    Vec3F move;
    const Matrix3& linear() const { return turn; }
    Vec3F moved(Vec3F p) const {
        const Vec3F v = turn * p;
        return {v.x + move.x, v.y + move.y, v.z + move.z};
    }
    Matrix4 operator*(const Matrix4& inner) const {
        Matrix4 m;
        for (std::size_t k = 0; k < 3; ++k) m.turn.column[k] = turn * inner.turn.column[k];
        m.move = moved(inner.move);
        return m;
    }
};

/// A node's matrix, or its translation, rotation (x y z w) and scale; empty vectors are left out.
/// Nothing if a number is not finite or immense.
inline std::optional<Matrix4> matrix_of(const std::vector<double>& matrix,
                                        const std::vector<double>& translation,
                                        const std::vector<double>& rotation,
                                        const std::vector<double>& scale) {
    for (const auto* numbers : {&matrix, &translation, &rotation, &scale}) {
        for (const double v : *numbers) {
            if (!(std::abs(v) <= 1e9)) return std::nullopt;
        }
    }
    const auto vec = [](const std::vector<double>& v, std::size_t i) {
        return Vec3F{float(v[i]), float(v[i + 1]), float(v[i + 2])};
    };
    Matrix4 m;
    if (matrix.size() == 16) {
        m.turn.column = {vec(matrix, 0), vec(matrix, 4), vec(matrix, 8)};
        m.move = vec(matrix, 12);
        return m;
    }
    if (rotation.size() == 4) {
        const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
        m.turn.column = {Vec3F{float(1 - 2 * (y * y + z * z)), float(2 * (x * y + z * w)),
                               float(2 * (x * z - y * w))},
                         Vec3F{float(2 * (x * y - z * w)), float(1 - 2 * (x * x + z * z)),
                               float(2 * (y * z + x * w))},
                         Vec3F{float(2 * (x * z + y * w)), float(2 * (y * z - x * w)),
                               float(1 - 2 * (x * x + y * y))}};
    }
    if (scale.size() == 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3F& c = m.turn.column[k];
            c = {c.x * float(scale[k]), c.y * float(scale[k]), c.z * float(scale[k])};
        }
    }
    if (translation.size() == 3) m.move = vec(translation, 0);
    return m;
}

}  // namespace verdigris
