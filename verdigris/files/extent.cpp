// SPDX-License-Identifier: MIT
#include "verdigris/files/decoders.h"

namespace verdigris {

void check_extent(const InputFile& file, std::int64_t width, std::int64_t height) {
    const std::string extent = std::to_string(width) + " x " + std::to_string(height);
    if (width <= 0 || height <= 0) file.refuse("declares an impossible size of " + extent);
    // Each side is below 2^32, so the product can exceed 63 bits; divide instead.
    if (width > kMaxImagePixels / height) {
        file.refuse("declares " + extent + " pixels, more than the " +
                    std::to_string(kMaxImagePixels) + " that are read");
    }
}

}  // namespace verdigris
