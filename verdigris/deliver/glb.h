// SPDX-License-Identifier: MIT
// The container of binary glTF: a header, a JSON chunk, a binary chunk. Written by hand because
// tinygltf 2.7 stores images in a GLB as data URIs, which the Khronos validator warns about.
// Source: [Gltf20] 4.4 (GLB File Format), 3.6 (Binary Data Storage).
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace verdigris {

/// Bytes for the binary chunk; every part starts at a multiple of 4.
class GlbBuffer {
  public:
    struct Part {
        std::size_t offset = 0, length = 0;
    };
    Part append(std::span<const std::byte> bytes);
    std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

/// The whole file: the JSON padded with spaces, the buffer with zeros, both to multiples of 4.
/// Throws Error{failed} above 4 GiB, which the format cannot hold.
std::vector<std::byte> glb_file(std::string_view json, std::span<const std::byte> buffer);

}  // namespace verdigris
