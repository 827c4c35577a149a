// SPDX-License-Identifier: MIT
// The header of a .npy file: written, and read with distrust. Used inside this room only.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "verdigris/files/input_file.h"
#include "verdigris/files/npy.h"

namespace verdigris {

/// Digits of the largest 64-bit count.
inline constexpr std::size_t kNpyCountDigits = 20;

/// Magic to newline, a multiple of 64 bytes. `reserve` extra characters are kept free, so that
/// a header whose first dimension grows later has the same length.
std::string npy_header(NpyType type, const std::vector<std::size_t>& shape, std::size_t reserve);

struct NpyLayout {
    NpyType type{};
    std::vector<std::size_t> shape;
    std::size_t data_offset = 0, data_bytes = 0;
};

/// Throws Error{bad_input} if the file is not what the header says, byte for byte.
NpyLayout read_npy_layout(InputFile& file);

/// "uint8", "float32": as NumPy calls them.
std::string npy_type_name(NpyType type);

}  // namespace verdigris
