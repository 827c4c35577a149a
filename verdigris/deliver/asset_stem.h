// SPDX-License-Identifier: MIT
// File names that import themselves: a stem that no tool mistakes for a map.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace verdigris {

/// A file stem for assets: CamelCase of `name`, without the words by which Blender's Node Wrangler
/// sorts maps ("metal", "base", "col", ...), never empty ("Specimen"). ASCII letters and digits
/// only, starts with a letter, at most 48 characters. "copper_patinating" -> "CopperPatinating",
/// "Metal_Base_AO_01" -> "Specimen01".
std::string asset_stem(const std::string& name);

/// How Node Wrangler reads a file name without its extension: digits dropped, split at aB and at
/// _ . - #, lower case. ("WallTexture_diff_2k" -> wall, texture, diff, k.)
std::vector<std::string> node_wrangler_words(std::string_view name);

/// True if Node Wrangler takes this word (lower case) for a map.
bool names_a_map(std::string_view word);

}  // namespace verdigris
