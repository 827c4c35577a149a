// SPDX-License-Identifier: MIT
// Text into lines of a given width, for any way of measuring text.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace verdigris {

using TextWidth = std::function<double(const std::string&)>;

/// Valid UTF-8 without control characters: bytes that are no UTF-8 become U+FFFD, a newline or tab
/// a space. What titles from file names go through before they are drawn.
std::string printable(std::string_view text);

/// `text` if it fits, else its longest beginning that fits with an ellipsis.
std::string ellipsized(const std::string& text, double width, const TextWidth& measure);

/// Lines no wider than `width`, broken at spaces, inside a word only if it alone is too wide. What
/// does not fit into `max_lines` is cut with an ellipsis.
std::vector<std::string> wrapped(const std::string& text, double width, int max_lines,
                                 const TextWidth& measure);

}  // namespace verdigris
