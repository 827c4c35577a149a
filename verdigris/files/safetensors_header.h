// SPDX-License-Identifier: MIT
// The header of a safetensors file: written, and read with distrust. Used inside this room only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verdigris/files/input_file.h"
#include "verdigris/files/safetensors.h"

namespace verdigris {

/// Before the header: its length, little-endian.
inline constexpr std::size_t kSafetensorsLengthBytes = 8;
/// The format's own limit.
inline constexpr std::uint64_t kSafetensorsHeaderLimit = 100'000'000;
/// chosen: what NumPy 2 and PyTorch can hold.
inline constexpr std::size_t kSafetensorsRankLimit = 64;
inline constexpr std::string_view kSafetensorsMetadataKey = "__metadata__";

/// Nothing for any other name.
std::optional<TensorType> tensor_type_from(std::string_view name);

/// Nothing if it is no whole number of bytes, or if a dimension is negative, or if a stride or the
/// size overflows.
std::optional<std::uint64_t> tensor_bytes(TensorType type, std::span<const std::int64_t> shape);

/// In quotes, escaped to ASCII, cut to a length that fits a sentence.
std::string quoted_name(std::string_view name);

/// A tensor as the header describes it.
struct TensorEntry {
    std::string name;
    TensorType type{};
    std::vector<std::int64_t> shape;
    std::uint64_t begin = 0, end = 0;  ///< in bytes, from the end of the header
};

struct SafetensorsHeader {
    std::map<std::string, std::string> metadata;
    std::vector<TensorEntry> tensors;  ///< in the order of their data, which they cover exactly
};

/// From the start of the file; leaves it at the first byte of data. Throws Error{bad_input} if
/// the file is not what the header says, byte for byte.
SafetensorsHeader read_safetensors_header(InputFile& file, const SafetensorsLimits& limits);

/// Length and JSON, a multiple of 8 bytes, tensors in the order given. Throws
/// std::invalid_argument: a name that is no UTF-8, a header over the format's limit.
std::string safetensors_header(const SafetensorsHeader& header);

}  // namespace verdigris
