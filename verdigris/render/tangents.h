// SPDX-License-Identifier: MIT
// Tangents as MikkTSpace makes them [Mikkelsen2008], which is how bakers make them: a normal map
// fits only the tangents it was made for.
#pragma once

#include "verdigris/render/shape.h"

namespace verdigris {

/// Replaces the tangents. Corners with the same position, normal and coordinate share one where
/// triangles around it are joined by edges and turn their map the same way; elsewhere the vertex is
/// doubled, so vertices are renumbered. Needs positions, normals, coordinates and triangles.
/// Our own: Debian 12 has no package of the reference code. tangents_test.cpp holds it to what
/// three.js' port of that code gives. Left out: angles of less than 180 degrees between tangents
/// that part, which its default never uses. Where a triangle has no area on the map its neighbors
/// decide, and any direction will do if there is none. O(n log n), about 150 bytes per triangle
/// while it runs.
void make_tangents(Shape& shape);

}  // namespace verdigris
