// SPDX-License-Identifier: MIT
// What a file is, from its first bytes. Used inside this room only.
#pragma once

#include <string>

#include "verdigris/files/input_file.h"

namespace verdigris {

enum class PictureFormat { none, png, jpeg, tiff, exr };

struct Sniffed {
    PictureFormat format{};
    std::string sentence;  ///< for `none`: what it is instead, "is text, not a picture"
};

/// Reads the start of the file; the position afterwards is unspecified.
Sniffed sniff(InputFile& file);

}  // namespace verdigris
