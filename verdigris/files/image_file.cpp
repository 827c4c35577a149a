// SPDX-License-Identifier: MIT
// From the first bytes to the codec, and from what the codec gives to a picture as shown.
#include "verdigris/files/image_file.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include "verdigris/files/decoders.h"
#include "verdigris/files/exif.h"
#include "verdigris/files/icc.h"
#include "verdigris/files/orientation.h"
#include "verdigris/files/sniff.h"

namespace verdigris {
namespace {

Decoded decode(InputFile& file, Want want) {
    const Sniffed found = sniff(file);
    file.seek(0);
    switch (found.format) {
        case PictureFormat::png:
            return decode_png(file, want);
        case PictureFormat::jpeg:
            return decode_jpeg(file, want);
        case PictureFormat::tiff:
            return decode_tiff(file, want);
        case PictureFormat::exr:
            return decode_exr(file, want);
        case PictureFormat::none:
            break;
    }
    file.refuse(found.sentence);
}

void apply_exif(Decoded& picture) {
    const ExifFacts& facts = picture.exif;
    ImageInfo& info = picture.info;
    info.orientation = facts.orientation;
    info.taken = facts.taken();
    info.camera = facts.camera();
    if (facts.color_space == 1) picture.tagged_srgb = true;
    // 2 and 65535 are how cameras mark Adobe RGB [EXIF, 4.6.5].
    if ((facts.color_space == 2 || facts.color_space == 65535) && picture.icc.empty()) {
        picture.notes.push_back({"color_space_unknown", Severity::caution,
                                 "the camera says that the colors are not sRGB (Adobe RGB?) but "
                                 "embedded no profile; they are read as sRGB"});
    }
}

template <class P>
constexpr bool kIsEncoded = std::is_same_v<P, SrgbU8> || std::is_same_v<P, SrgbU16>;

// What the samples mean, in words; and the samples themselves, if `pixels` were decoded.
void apply_color(Decoded& picture, Want want) {
    std::string& color = picture.info.color;
    if (!color.empty()) return;  // the codec knows (EXR)
    color = picture.tagged_srgb ? "sRGB" : "sRGB (assumed)";
    if (picture.icc.empty()) return;
    const IccProfile profile(picture.icc);
    if (!profile.usable_for(picture.gray)) {
        picture.notes.push_back({"icc_ignored", Severity::caution,
                                 "the embedded color profile cannot be used; the picture is read "
                                 "as sRGB"});
        return;
    }
    color = "ICC: " + profile.name();
    if (profile.is_srgb()) return;
    picture.notes.push_back({"icc_converted", Severity::info,
                             "converted to sRGB from the embedded profile '" + profile.name() +
                                 "'; colors outside of sRGB are clipped"});
    if (want == Want::header) return;
    using Pixels = decltype(picture.pixels);  // named here: Clang 14 crashes if the lambda says it
    picture.pixels = std::visit(
        [&](auto& image) -> Pixels {
            using P = std::remove_reference_t<decltype(image(0, 0))>;
            if constexpr (kIsEncoded<P>) return profile.srgb_from(image.view());
            return std::move(image);
        },
        picture.pixels);
}

void apply_orientation(Decoded& picture, Want want) {
    ImageInfo& info = picture.info;
    if (swaps_sides(info.orientation)) std::swap(info.width, info.height);
    if (want == Want::header || info.orientation == 1) return;
    std::visit([&](auto& image) { image = oriented(std::move(image), info.orientation); },
               picture.pixels);
}

Decoded read(const std::filesystem::path& path, Want want) {
    InputFile file(path);
    try {
        Decoded picture = decode(file, want);
        apply_exif(picture);
        apply_color(picture, want);
        apply_orientation(picture, want);
        for (Status& note : picture.notes) {
            note.sentence = path.filename().string() + ": " + note.sentence;
        }
        return picture;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::failed, "does not fit into memory", path.string());
    } catch (const std::length_error&) {
        file.refuse("declares an impossible size");
    }
}

}  // namespace

ImageInfo read_image_info(const std::filesystem::path& path) {
    return read(path, Want::header).info;
}

ImageFile read_image(const std::filesystem::path& path) {
    Decoded picture = read(path, Want::pixels);
    return {std::move(picture.info), std::move(picture.pixels), std::move(picture.notes)};
}

bool looks_like_image(const std::filesystem::path& path) {
    try {
        InputFile file(path);
        return sniff(file).format != PictureFormat::none;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace verdigris
