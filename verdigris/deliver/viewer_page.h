// SPDX-License-Identifier: MIT
// The viewer's page as it was built. CMake picks the source: viewer_builtin.cpp (with the page
// linked in) or viewer_absent.cpp (built without node).
#pragma once

#include <string_view>

namespace verdigris {

/// Empty if this build has none.
std::string_view viewer_page();

}  // namespace verdigris
