// SPDX-License-Identifier: MIT
// A shape of one's own: a GLB.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "verdigris/progress.h"
#include "verdigris/render/shape.h"

namespace verdigris {

/// chosen: what fits beside its tree of rays into 4 GB.
inline constexpr std::size_t kMaxTriangles = 20'000'000;

/// All triangles of the default scene (or of the first) of a binary glTF 2.0, moved as its nodes
/// say. Its materials are not looked at. Normals that are missing are those of the faces, and
/// tangents that are missing MikkTSpace's, as glTF asks. Coordinates: TEXCOORD_0.
/// Throws Error{bad_input} with a sentence: not a GLB, truncated, a number that points outside of
/// the file or is not finite, compressed (Draco, meshopt), an extension it cannot do without that
/// is not read, sparse, no triangles, none with an area, more than kMaxTriangles, no texture
/// coordinates, numbers in another file (none is opened), more than a million nodes and parts of
/// meshes, each counted as often as it is shown. Where a part has more vertices than its triangles
/// have corners, those without a triangle are left out.
Shape read_model(const std::filesystem::path& path);

}  // namespace verdigris
