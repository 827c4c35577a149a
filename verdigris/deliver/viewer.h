// SPDX-License-Identifier: MIT
// The page in which the age can be scrubbed: the built viewer with one JSON document in it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "verdigris/deliver/delivery.h"
#include "verdigris/progress.h"

namespace verdigris {

/// The self-contained viewer. Throws Error{failed} if this build has none (built without node).
void write_viewer(const Delivery& delivery, const std::filesystem::path& file,
                  const Progress& progress = {});
bool viewer_is_built_in();

/// The document of docs/VIEWER_DATA.md. Every "<" is written as \u003c.
std::string viewer_json(const Delivery& delivery, const Progress& progress = {});

/// `page` with its one data token replaced by `json`.
/// Throws Error{failed} if the token is not there exactly once.
std::string filled_viewer_page(std::string_view page, std::string_view json);

}  // namespace verdigris
