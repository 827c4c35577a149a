// SPDX-License-Identifier: MIT
// safetensors ([Safetensors]): named arrays of numbers and a map of strings in one file, in which
// nothing can be executed. How the weights of networks are kept, ours and those users bring.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace verdigris {

/// Every element type of the format, in its order: by alignment, then as its authors list them.
/// Files are laid out by it, so it must not change.
enum class TensorType {
    boolean,
    f4,
    f6_e2m3,
    f6_e3m2,
    u8,
    i8,
    f8_e5m2,
    f8_e4m3,
    f8_e8m0,
    f8_e4m3fnuz,
    f8_e5m2fnuz,
    i16,
    u16,
    f16,
    bf16,
    i32,
    u32,
    f32,
    c64,
    f64,
    i64,
    u64
};
/// As it stands in a file: "F32", "BOOL".
std::string_view to_string(TensorType type);
/// Of one element. Three types are smaller than a byte; their elements lie without gaps.
std::size_t bit_size(TensorType type);

/// One array: row-major, little-endian, without gaps. An empty shape is a scalar; a dimension of
/// zero makes an array without elements.
struct Tensor {
    std::string name;                 ///< UTF-8; unique in its file; not "__metadata__"
    TensorType type{};                ///< of the elements
    std::vector<std::int64_t> shape;  ///< non-negative, at most 64 dimensions
    std::vector<std::byte> bytes;     ///< product of `shape` times the size of `type`; any values,
                                      ///< NaN and infinities included; aligned for every type

    bool operator==(const Tensor&) const = default;
};

struct SafetensorsFile {
    std::map<std::string, std::string> metadata;  ///< UTF-8 to UTF-8
    std::vector<Tensor> tensors;                  ///< as read: in the order of their data

    /// nullptr if there is none. Looks at every tensor.
    const Tensor* find(std::string_view name) const;
};

/// What is refused although the format allows it, because no network has it and a file that does
/// wants our memory or time. Chosen well above what is published in one file.
struct SafetensorsLimits {
    std::uint64_t file_bytes = std::uint64_t(1) << 32;
    std::size_t tensors = 100'000;
    std::size_t metadata_entries = 10'000;
};

/// The whole file. Everything the header says is held against the size of the file before memory
/// for data is taken; at most the size of the data plus 16 times that of the header is in use.
/// Throws Error{bad_input} naming the file, and the tensor in the sentence: missing, over the
/// limits, truncated, or anything but what the format allows (unknown types, duplicate names,
/// data that overlap, leave holes or do not match the shape).
SafetensorsFile read_safetensors(const std::filesystem::path& path,
                                 const SafetensorsLimits& limits = {});

/// The strings alone, from the header alone; `limits.file_bytes` does not apply. Throws what
/// read_safetensors() throws, because the header is checked all the same.
std::map<std::string, std::string> read_safetensors_metadata(const std::filesystem::path& path,
                                                             const SafetensorsLimits& limits = {});

/// Whole or not at all. The bytes depend on what is in `file`, not on its order: wider types first,
/// then by name, metadata by key. Bytes of a metadata value that are no UTF-8 become U+FFFD.
/// Throws Error{failed} (disk full); std::invalid_argument if `file` breaks a rule above or the
/// default limits, so that what is written can be read.
void write_safetensors(const std::filesystem::path& path, const SafetensorsFile& file);

/// All elements as float32: F64 is rounded to nearest (infinite beyond the range), F16 and BF16 are
/// exact. `where` names the file in the Error{bad_input} that any other type gets.
std::vector<float> floats(const Tensor& tensor, const std::string& where = {});

/// A tensor of type F32. Throws std::invalid_argument if `values` do not fill `shape`.
Tensor float_tensor(std::string name, std::vector<std::int64_t> shape,
                    std::span<const float> values);

}  // namespace verdigris
