// SPDX-License-Identifier: MIT
// The order people expect of numbered files: "2.png" before "10.png".
#pragma once

#include <string_view>

namespace verdigris {

/// True if `a` comes before `b`: runs of digits compare as numbers, letters without regard to
/// case; names equal in that sense compare byte by byte, so that the order is total.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace verdigris
