// SPDX-License-Identifier: MIT
// The templates of report.html as they were built by apps/report, linked into the library.
#pragma once

#include <string_view>

namespace verdigris {

/// With scripts; empty if this build has none (built without node).
std::string_view interactive_page();
/// Without any script; always there.
std::string_view plain_page();

}  // namespace verdigris
