// SPDX-License-Identifier: MIT
// Pictures in: PNG (8, 16 bit), JPEG, TIFF (8, 16 bit integer), OpenEXR (half, float).
// The format is found from the first bytes, never from the name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/status.h"

namespace verdigris {

/// chosen: 2^28 pixels (16384 x 16384). A declared 65,000 x 65,000 is refused from the header,
/// before memory is asked for.
inline constexpr std::int64_t kMaxImagePixels = std::int64_t(1) << 28;

/// What the header says; no pixel is decoded.
struct ImageInfo {
    std::string format;           ///< "png", "jpeg", "tiff", "exr"
    int width = 0, height = 0;    ///< as shown: EXIF orientation applied
    int bits = 0;                 ///< per sample: 8, 16 (half counts as 16), 32
    bool is_float = false;        ///< EXR
    int orientation = 1;          ///< EXIF 1..8, already applied to width and height
    std::string color;            ///< how the color is known: "sRGB (assumed)", "ICC: Display P3",
                                  ///< "linear (EXR)", "EXR chromaticities: ACEScg"
    std::optional<double> taken;  ///< EXIF DateTimeOriginal + SubSec - OffsetTime, seconds since
                                  ///< 1970 (as UTC when no offset is recorded)
    std::string camera;           ///< EXIF make, model, ISO, exposure: "" if absent
};

/// Pixels as shown (orientation applied), as encoded sRGB or linear light on sRGB primaries:
/// an ICC profile other than sRGB is converted (to SrgbU16, via lcms2), gray is replicated, alpha
/// is dropped, EXR chromaticities are converted. What was done is in `notes`.
struct ImageFile {
    ImageInfo info;
    std::variant<Image<SrgbU8>, Image<SrgbU16>, Image<LinearF>> pixels;
    Statuses notes;
};

/// Throws Error{bad_input} with a sentence: missing, not a picture we read ("is text, not a
/// picture"), truncated, more than kMaxImagePixels, NaN or infinity in an EXR (naming a pixel).
ImageInfo read_image_info(const std::filesystem::path& path);
ImageFile read_image(const std::filesystem::path& path);

/// True if the first bytes are of a format read_image knows.
bool looks_like_image(const std::filesystem::path& path);

/// Half-float RGB OpenEXR, scanlines, PIZ, linear sRGB primaries. Throws Error{failed}.
void write_exr(const std::filesystem::path& path, ImageView<const LinearF> image);
/// One-channel float32 OpenEXR named "Y" (height). Throws Error{failed}.
void write_exr(const std::filesystem::path& path, ImageView<const float> image);

}  // namespace verdigris
