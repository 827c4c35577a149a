// SPDX-License-Identifier: MIT
// Files for the reader tests, made by the reference libraries and never by our own writers.
#pragma once

#include <tiffio.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/files/image_file.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// A small picture in which every pixel is different from its neighbors: 7 x 5 unless said.
Image<SrgbU8> test_picture(int width = 7, int height = 5);
Image<SrgbU16> test_picture16(int width = 7, int height = 5);

struct PngSpec {
    int width = 7, height = 5, bits = 8, color_type = 2;
    bool interlaced = false;
    std::vector<SrgbU8> palette = {};
    std::vector<std::uint8_t> transparency = {};  ///< of the palette
    double gamma = 0;
    std::vector<std::byte> icc = {}, exif = {};
    /// Sample (channel c) at (x, y), as stored.
    std::function<unsigned(int x, int y, int c)> sample;
};
std::vector<std::byte> make_png(const PngSpec& spec);

struct JpegSpec {
    int quality = 100;
    bool gray = false, progressive = false, cmyk = false;
    std::vector<std::byte> icc = {}, exif = {};
};
std::vector<std::byte> make_jpeg(const Image<SrgbU8>& image, const JpegSpec& spec = {});

/// `fill` sets tags and writes the pixels.
void make_tiff(const std::filesystem::path& path, const std::function<void(TIFF*)>& fill,
               const char* mode = "w");
/// The tags that every TIFF needs.
void set_tiff_size(TIFF* tiff, int width, int height, int bits, int samples, int photometric);

/// A TIFF structure with orientation, camera, exposure and times, as cameras write it.
struct ExifSpec {
    int orientation = 1;
    std::string date = "2026:03:01 12:00:00", subseconds = "25", offset = "+02:00";
    int color_space = 1;
    bool big_endian = false;
};
std::vector<std::byte> make_exif(const ExifSpec& spec = {});

/// Profiles made by lcms2. Display P3 with the sRGB curve; sRGB; linear gray.
std::vector<std::byte> make_icc_p3();
std::vector<std::byte> make_icc_srgb();
std::vector<std::byte> make_icc_linear_gray();

}  // namespace verdigris
