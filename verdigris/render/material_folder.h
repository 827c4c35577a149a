// SPDX-License-Identifier: MIT
// A folder of maps, as `verdigris deliver` and most libraries of materials write it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "verdigris/material/material.h"

namespace verdigris {

/// chosen: 8192 x 8192, twice what libraries usually offer; 4 GB while read.
inline constexpr std::int64_t kMaxMaterialPixels = std::int64_t(1) << 26;

/// Maps are found by how a name ends, in any case and any format that read_image() takes:
///   _Color, _BaseColor, _Albedo, _Diffuse    needed; encoded sRGB
///   _NormalGL, _Normal, or _NormalDX         +Y up, or down; flat if there is none
///   _Roughness                               needed, unless there is an _ORM
///   _Metalness, _Metallic                    no metal if there is none
///   _ORM                                     roughness in green, metallic in blue
/// Where masters16/ has a map of the same name, that is read: 8-bit normals show steps in a smooth
/// reflection. height and coverage of the result stay empty.
/// Throws Error{bad_input}: no folder, a map that is missing, there twice, larger than
/// kMaxMaterialPixels or of another size than the color, and what read_image() says.
Material read_material_folder(const std::filesystem::path& folder);

/// True if a folder holds a map of colors: what read_material_folder() begins with.
bool is_material_folder(const std::filesystem::path& folder);

/// Its maps, with those in masters16/: what a picture of it must not be written over.
std::vector<std::filesystem::path> maps_of_material_folder(const std::filesystem::path& folder);

}  // namespace verdigris
