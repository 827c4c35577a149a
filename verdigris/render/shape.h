// SPDX-License-Identifier: MIT
// What a material is put on: triangles with normals, tangents and texture coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "verdigris/pixels/image.h"
#include "verdigris/render/surface_maps.h"

namespace verdigris {

struct TextureCoordinate {
    float u = 0, v = 0;  ///< v down, as glTF
};
/// A unit vector along u, at right angles to the normal. The bitangent, along -v, is
/// cross(normal, direction) * sign, as glTF.
struct Tangent {
    Vec3F direction;
    float sign = 1;
};

/// All vectors but `triangles` have one entry per vertex. +Y is up.
struct Shape {
    std::vector<Vec3F> positions;
    std::vector<Vec3F> normals;  ///< unit
    std::vector<Tangent> tangents;
    std::vector<TextureCoordinate> coordinates;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from the front
    bool hides_itself = true;  ///< false: convex, or flat: light reaches every point it faces
    Beyond beyond = Beyond::edge;

    std::size_t vertex_count() const { return positions.size(); }
};

/// In the XY plane, facing +Z; its longer side is 2.
Shape plate_shape(double width_over_height);

/// Radius 1. The map covers the half that faces +Z, from pole to pole, and covers the other half
/// mirrored, so that no seam shows where its edges do not match.
Shape sphere_shape(int rings = 160);

/// A square cloth laid over a ball: the map covers it once. Fits into radius 1. Positions follow a
/// formula; normals and tangents are its derivatives, not estimates.
Shape drape_shape(int cells = 320);

}  // namespace verdigris
