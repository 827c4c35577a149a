// SPDX-License-Identifier: MIT
// JSON out of this room. Not a public header of the room: it names a third-party type.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace verdigris {

/// Compact, or indented by two; bytes that are not UTF-8 (hostile file names) become U+FFFD
/// instead of an exception.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = -1) {
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace verdigris
