// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "verdigris/render/drape.h"
#include "verdigris/render/shape.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

// Two triangles per cell of a grid of (columns + 1) x (rows + 1) vertices, v down.
void join_grid(Shape& shape, int columns, int rows) {
    const auto at = [&](int x, int y) { return std::uint32_t(y * (columns + 1) + x); };
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            shape.triangles.push_back({at(x, y), at(x, y + 1), at(x + 1, y + 1)});
            shape.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x + 1, y)});
        }
    }
}

}  // namespace

Shape plate_shape(double width_over_height) {
    const float width = float(std::min(1.0, width_over_height));
    const float height = float(std::min(1.0, 1 / width_over_height));
    Shape shape;
    for (const float v : {0.0f, 1.0f}) {
        for (const float u : {0.0f, 1.0f}) {
            shape.positions.push_back({(2 * u - 1) * width, (1 - 2 * v) * height, 0});
            shape.normals.push_back({0, 0, 1});
            shape.tangents.push_back({{1, 0, 0}, 1});
            shape.coordinates.push_back({u, v});
        }
    }
    join_grid(shape, 1, 1);
    shape.hides_itself = false;
    return shape;
}

Shape sphere_shape(int rings) {
    const int columns = 2 * rings;  // an even number: vertices lie where the map turns around
    Shape shape;
    // Front and back have vertices of their own along the turn, where the tangent changes sign.
    for (const bool front : {true, false}) {
        const auto first = std::uint32_t(shape.vertex_count());
        for (int y = 0; y <= rings; ++y) {
            for (int x = 0; x <= columns / 2; ++x) {
                const double across = double(x) / (columns / 2);  // left to right, as seen
                const double polar = double(y) / rings * double(kPi);
                const double around = (across - 0.5) * double(kPi) + (front ? 0 : double(kPi));
                const double r = std::sin(polar);
                const Vec3F n{float(r * std::sin(around)), float(std::cos(polar)),
                              float(r * std::cos(around))};
                const float east = front ? 1.0f : -1.0f;  // the mirrored half counts westwards
                shape.positions.push_back(n);
                shape.normals.push_back(n);
                shape.tangents.push_back(
                    {{float(std::cos(around)) * east, 0, float(-std::sin(around)) * east}, east});
                shape.coordinates.push_back(
                    {float(front ? across : 1 - across), float(double(y) / rings)});
            }
        }
        Shape half;
        join_grid(half, columns / 2, rings);
        for (const auto& t : half.triangles) {
            shape.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        }
    }
    // Cells at the poles have a side of length 0.
    std::erase_if(shape.triangles, [&](const auto& t) {
        const auto at = [&](std::size_t k) { return shape.positions[t[k]]; };
        return length(cross(at(1) - at(0), at(2) - at(0))) < 1e-9f;
    });
    shape.hides_itself = false;
    return shape;
}

Shape drape_shape(int cells) {
    Shape shape;
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const double u = double(x) / cells, v = double(y) / cells;
            const DrapePoint p = drape_point(u, v);
            const Vec3F n = unit(cross(p.along_u, -p.along_v));
            const Vec3F t = p.along_u - n * dot(n, p.along_u);
            shape.positions.push_back(p.position);
            shape.normals.push_back(n);
            shape.tangents.push_back({unit(t), 1});
            shape.coordinates.push_back({float(u), float(v)});
        }
    }
    join_grid(shape, cells, cells);
    return shape;
}

}  // namespace verdigris
