// SPDX-License-Identifier: MIT
// Safetensors files from their parts, as hostile as wanted. For tests of this room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "verdigris/files/testing.h"

namespace verdigris {

/// Length, header and data, without any check.
inline std::string safetensors_text(std::string_view header, std::string_view data = {}) {
    std::string text;
    for (int i = 0; i < 8; ++i) text += char(std::uint64_t(header.size()) >> (8 * i) & 0xff);
    return text.append(header).append(data);
}

inline void put_text(const std::filesystem::path& path, std::string_view text) {
    put_bytes(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace verdigris
