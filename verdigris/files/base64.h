// SPDX-License-Identifier: MIT
// Bytes inside text: pictures in a page, arrays in a document.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace verdigris {

/// [RFC4648], section 4, with padding.
std::string base64(std::span<const std::byte> bytes);

}  // namespace verdigris
