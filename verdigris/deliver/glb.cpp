// SPDX-License-Identifier: MIT
#include "verdigris/deliver/glb.h"

#include <cstdint>
#include <limits>

#include "verdigris/error.h"

namespace verdigris {
namespace {

// Four characters read as a little-endian number, [Gltf20] 4.4.
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN\0"
constexpr std::size_t kAlignment = 4;

std::size_t aligned(std::size_t size) {
    return (size + kAlignment - 1) / kAlignment * kAlignment;
}

void append_u32(std::vector<std::byte>& out, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) out.push_back(std::byte((value >> shift) & 0xFF));
}

void append_chunk(std::vector<std::byte>& out, std::uint32_t type, std::span<const std::byte> bytes,
                  char padding) {
    append_u32(out, aligned(bytes.size()));
    append_u32(out, type);
    out.insert(out.end(), bytes.begin(), bytes.end());
    out.resize(aligned(out.size()), std::byte(padding));
}

}  // namespace

GlbBuffer::Part GlbBuffer::append(std::span<const std::byte> bytes) {
    bytes_.resize(aligned(bytes_.size()));
    const Part part{bytes_.size(), bytes.size()};
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return part;
}

std::vector<std::byte> glb_file(std::string_view json, std::span<const std::byte> buffer) {
    const std::size_t total = 12 + 8 + aligned(json.size()) + 8 + aligned(buffer.size());
    if (total > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::failed,
                    "the maps need more than the 4 GB that one GLB can hold; deliver fewer "
                    "horizons or a smaller size");
    }
    std::vector<std::byte> out;
    out.reserve(total);
    append_u32(out, kMagic);
    append_u32(out, 2);
    append_u32(out, total);
    append_chunk(out, kJsonChunk, std::as_bytes(std::span(json)), ' ');
    append_chunk(out, kBinChunk, buffer, '\0');
    return out;
}

}  // namespace verdigris
