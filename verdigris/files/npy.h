// SPDX-License-Identifier: MIT
// NumPy .npy, version 1.0, C order, little-endian: how stages hand arrays to each other and to
// researchers ([NumpyFormat]).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "verdigris/files/atomic_file.h"

namespace verdigris {

enum class NpyType { u8, u16, f32, f64 };
std::size_t byte_size(NpyType type);

/// Appends frames to an array whose first dimension is known last; memory does not grow.
class NpyWriter {
  public:
    /// `frame_shape` is the shape without the first dimension, e.g. {height, width, 3}.
    NpyWriter(std::filesystem::path target, NpyType type, std::vector<std::size_t> frame_shape);
    /// `frame` must be exactly one frame. Throws Error{failed} (disk full).
    void append(std::span<const std::byte> frame);
    std::size_t count() const { return count_; }
    void commit();

  private:
    AtomicFile file_;
    NpyType type_;
    std::vector<std::size_t> frame_shape_;
    std::size_t frame_bytes_ = 0, count_ = 0;
};

/// A memory-mapped .npy file, read-only. Cheap to copy; the mapping ends with the last copy.
class NpyFile {
  public:
    NpyFile() = default;
    /// Throws Error{bad_input}: missing, not .npy, Fortran order, big-endian, an unsupported
    /// type, or a length that does not match the shape (truncated).
    explicit NpyFile(const std::filesystem::path& path);

    NpyType type() const { return type_; }
    const std::vector<std::size_t>& shape() const { return shape_; }
    /// All elements. Throws Error{bad_input} if T is not the stored type.
    template <class T>
    std::span<const T> values() const;

  private:
    std::filesystem::path path_;
    std::shared_ptr<const void> mapping_;
    const std::byte* data_ = nullptr;
    std::size_t bytes_ = 0;
    NpyType type_{};
    std::vector<std::size_t> shape_;
};

/// A whole array in one call.
void write_npy(const std::filesystem::path& path, NpyType type,
               const std::vector<std::size_t>& shape, std::span<const std::byte> values);

}  // namespace verdigris
