// SPDX-License-Identifier: MIT
#include "verdigris/files/sniff.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace verdigris {
namespace {

using namespace std::string_view_literals;

struct Signature {
    std::size_t offset;
    std::string_view bytes;
    PictureFormat format;
    std::string_view otherwise;
};

// The first match counts. Sources: [PNG, 5.2], [JPEG, B.1], [TIFF6, 2], [EXR, magic number]; the
// others are the first bytes by which `file` knows them.
constexpr Signature kSignatures[] = {
    {0, "\x89PNG\r\n\x1a\n"sv, PictureFormat::png, ""},
    {0, "\xff\xd8\xff"sv, PictureFormat::jpeg, ""},
    {8, "CR\2"sv, PictureFormat::none, "is a camera raw file (CR2); develop it to 16-bit TIFF"},
    {0, "II*\0"sv, PictureFormat::tiff, ""},
    {0, "MM\0*"sv, PictureFormat::tiff, ""},
    {0, "II+\0"sv, PictureFormat::tiff, ""},  // BigTIFF
    {0, "MM\0+"sv, PictureFormat::tiff, ""},
    {0, "\x76\x2f\x31\x01"sv, PictureFormat::exr, ""},
    {0, "GIF8"sv, PictureFormat::none, "is a GIF, which is not read; convert it to PNG"},
    {8, "WEBP"sv, PictureFormat::none, "is a WebP picture, which is not read; convert it to PNG"},
    {4, "ftypheic"sv, PictureFormat::none,
     "is a HEIC picture, which is not read; convert it to PNG or JPEG"},
    {4, "ftypheix"sv, PictureFormat::none,
     "is a HEIC picture, which is not read; convert it to PNG or JPEG"},
    {4, "ftypmif1"sv, PictureFormat::none,
     "is a HEIF picture, which is not read; convert it to PNG or JPEG"},
    {4, "ftypavif"sv, PictureFormat::none,
     "is an AVIF picture, which is not read; convert it to PNG"},
    {4, "ftypcrx"sv, PictureFormat::none, "is a camera raw file (CR3); develop it to 16-bit TIFF"},
    {0, "FUJIFILMCCD-RAW"sv, PictureFormat::none,
     "is a camera raw file (RAF); develop it to 16-bit TIFF"},
    {4, "ftyp"sv, PictureFormat::none, "is a video, not a picture"},
    {0, "\x1a\x45\xdf\xa3"sv, PictureFormat::none, "is a video, not a picture"},
    {8, "AVI "sv, PictureFormat::none, "is a video, not a picture"},
    {0, "BM"sv, PictureFormat::none, "is a BMP or unknown, which is not read; convert it to PNG"},
    {0, "8BPS"sv, PictureFormat::none, "is a Photoshop file; export it as PNG or TIFF"},
    {0, "%PDF"sv, PictureFormat::none, "is a PDF, not a picture"},
    {0, "PK\3\4"sv, PictureFormat::none, "is a ZIP archive, not a picture"},
};

// No control characters but white space. Bytes above 127 may be any text encoding.
bool is_text(std::string_view start) {
    return std::all_of(start.begin(), start.end(), [](char c) {
        return c == '\t' || c == '\n' || c == '\r' || c == '\f' ||
               static_cast<signed char>(c) < 0 || (c >= ' ' && c != '\x7f');
    });
}

}  // namespace

Sniffed sniff(InputFile& file) {
    if (file.size() == 0) return {PictureFormat::none, "is empty"};
    std::array<char, 512> bytes{};
    const std::size_t got = file.read(std::as_writable_bytes(std::span(bytes)));
    const std::string_view start(bytes.data(), got);
    for (const Signature& s : kSignatures) {
        if (start.size() >= s.offset && start.substr(s.offset, s.bytes.size()) == s.bytes) {
            // Two letters also begin words.
            if (s.bytes.size() == 2 && is_text(start)) continue;
            return {s.format, std::string(s.otherwise)};
        }
    }
    if (is_text(start)) return {PictureFormat::none, "is text, not a picture"};
    return {PictureFormat::none, "is not a picture that can be read (PNG, JPEG, TIFF, OpenEXR)"};
}

}  // namespace verdigris
