// SPDX-License-Identifier: MIT
// Texture packs in ambientCG naming: what artists drop into any tool.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/deliver/delivery.h"
#include "verdigris/progress.h"

namespace verdigris {

/// Into `folder`, which is the textures folder itself: <Stem>_u010/<Stem>_u010[_2K]_Color.png,
/// _NormalGL, _Roughness, _Metalness, _Displacement (16 bit), _ORM; dx/..._NormalDX; masters16/
/// 16-bit of each; README.txt with the conventions. One pack per horizon and one for the observed
/// state (u000). "2K" only if true.
/// Returns the files written, relative to `folder`. Throws Error{failed}.
std::vector<std::filesystem::path> write_textures(const Delivery& delivery,
                                                  const std::filesystem::path& folder,
                                                  const Progress& progress = {});

/// "<Stem>_u010" or, if the long side is 1024, 2048, ... 16384, "<Stem>_u010_2K": what stands
/// before "_Color.png".
std::string texture_prefix(const Delivery& delivery, const DeliveredState& state, int width,
                           int height);

/// The README.txt of one pack.
std::string texture_readme(const Delivery& delivery, const DeliveredState& state,
                           const std::string& prefix, int width, int height);

}  // namespace verdigris
