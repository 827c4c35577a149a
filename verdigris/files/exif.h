// SPDX-License-Identifier: MIT
// What a camera wrote beside the pixels. Used inside this room only.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace verdigris {

/// Texts and numbers as recorded; empty or 0 where absent.
struct ExifFacts {
    int orientation = 1;                   ///< 1..8 [EXIF, 4.6.4]
    std::string date, subseconds, offset;  ///< DateTimeOriginal and its two companions
    std::string make, model;
    int iso = 0;
    double exposure_seconds = 0, f_number = 0;
    int color_space = 0;  ///< 1 sRGB, 2 or 65535: something else

    /// Seconds since 1970; nothing if absent or nonsense.
    std::optional<double> taken() const;
    /// "Canon EOS R5, ISO 100, 1/125 s, f/8"; "" if nothing is known.
    std::string camera() const;
};

/// `data` is a TIFF structure ("II*..." or "MM..."), without the "Exif\0\0" before it. Damaged
/// data give what can be read.
ExifFacts read_exif(std::span<const std::byte> data);

}  // namespace verdigris
