// SPDX-License-Identifier: MIT
// PNG out: fast (libdeflate level 1 behind the Up filter; rows are filtered in parallel, the
// compression is one stream, because libdeflate cannot end a block on a byte: encode several maps
// at once to use more cores). Tagged by pixel type: color maps carry sRGB, gAMA and cHRM; data
// maps carry none of them, because some loaders apply gamma to tagged data. 16-bit samples are
// big-endian as [PNG] asks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// One text chunk (iTXt, UTF-8). Keyword "XML:com.adobe.xmp" carries XMP.
struct PngText {
    std::string keyword, text;
};

struct PngOptions {
    /// libdeflate 1..12. chosen: 1 is ~25x faster than libpng's default, for 14 % more bytes.
    int level = 1;
    std::vector<PngText> text = {};
};

/// The PNG as bytes. Same pixels, same options, same bytes at any thread count.
std::vector<std::byte> encode_png(ImageView<const SrgbU8> image, const PngOptions& options = {});
std::vector<std::byte> encode_png(ImageView<const SrgbU16> image, const PngOptions& options = {});
std::vector<std::byte> encode_png(ImageView<const Vec3U8> image, const PngOptions& options = {});
std::vector<std::byte> encode_png(ImageView<const Vec3U16> image, const PngOptions& options = {});
std::vector<std::byte> encode_png(ImageView<const std::uint8_t> image,
                                  const PngOptions& options = {});
std::vector<std::byte> encode_png(ImageView<const std::uint16_t> image,
                                  const PngOptions& options = {});

/// encode_png, then an atomic write. Throws Error{failed} naming `path`.
template <class P>
void write_png(const std::filesystem::path& path, ImageView<const P> image,
               const PngOptions& options = {});
template <class P>
void write_png(const std::filesystem::path& path, const Image<P>& image,
               const PngOptions& options = {}) {
    write_png<P>(path, image.view(), options);
}

/// A single-channel 8-bit PNG as it was written (masks). Throws Error{bad_input} otherwise.
Image<std::uint8_t> read_gray_png(const std::filesystem::path& path);

}  // namespace verdigris
