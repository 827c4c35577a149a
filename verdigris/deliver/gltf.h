// SPDX-License-Identifier: MIT
// One file that opens in any 3D viewer: every state of the material as a variant.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "verdigris/deliver/delivery.h"
#include "verdigris/progress.h"

namespace verdigris {

/// One GLB: a flat quad with tangents, KHR_materials_variants, a variant per horizon and one for
/// the observed state, which is also the default. gltf-validator: 0 errors, 0 warnings.
/// The quad lies in the XY plane, faces +Z, has the picture's aspect and is 0.1 m long.
/// Throws Error{failed}.
void write_gltf(const Delivery& delivery, const std::filesystem::path& file,
                const Progress& progress = {});

/// The same as bytes.
std::vector<std::byte> encode_gltf(const Delivery& delivery, const Progress& progress = {});

}  // namespace verdigris
