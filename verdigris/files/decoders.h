// SPDX-License-Identifier: MIT
// What each codec hands to read_image before color and orientation are settled, and the codecs
// themselves. Used inside this room only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "verdigris/files/exif.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/input_file.h"

namespace verdigris {

enum class Want { header, pixels };

struct Decoded {
    /// width and height as coded; orientation, taken and camera are filled from `exif` later.
    ImageInfo info;
    /// As coded: not turned, not converted. Gray is replicated already. Empty for Want::header.
    std::variant<Image<SrgbU8>, Image<SrgbU16>, Image<LinearF>> pixels;
    bool gray = false;
    std::vector<std::byte> icc;  ///< an embedded profile, empty if none
    ExifFacts exif;
    bool tagged_srgb = false;  ///< the container itself says sRGB
    Statuses notes;            ///< without the file's name, which read_image puts before them
};

Decoded decode_png(InputFile& file, Want want);
Decoded decode_jpeg(InputFile& file, Want want);
Decoded decode_tiff(InputFile& file, Want want);
Decoded decode_exr(InputFile& file, Want want);

/// Throws Error{bad_input} if the header declares no pixels or more than kMaxImagePixels.
void check_extent(const InputFile& file, std::int64_t width, std::int64_t height);

}  // namespace verdigris
