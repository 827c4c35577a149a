// SPDX-License-Identifier: MIT
// A recipe on disk: recipe.json (all options and scalars), canvas.npy, dead_zone.npy,
// luma_fill.npy, active.png.
#pragma once

#include <filesystem>

#include "verdigris/material/material.h"

namespace verdigris {

/// recipe.json goes last. Throws Error{failed}.
void write_recipe(const MaterialRecipe& recipe, const std::filesystem::path& folder);
/// Throws Error{bad_input} naming the file.
MaterialRecipe read_recipe(const std::filesystem::path& folder);

}  // namespace verdigris
