// SPDX-License-Identifier: MIT
// One picture that tells the whole story: what was seen, what is forecast, how far to trust it.
#pragma once

#include <filesystem>

#include "verdigris/color/pixel_types.h"
#include "verdigris/deliver/delivery.h"
#include "verdigris/pixels/image.h"
#include "verdigris/progress.h"

namespace verdigris {

/// Observed and forecast frames in a row, change map, maps, guards in words: a PNG.
/// Throws Error{failed}.
void write_contact_sheet(const Delivery& delivery, const std::filesystem::path& file,
                         const Progress& progress = {});

/// The same as pixels. Text is set in DejaVu Sans, or what fontconfig has instead.
Image<SrgbU8> draw_contact_sheet(const Delivery& delivery, const Progress& progress = {});

}  // namespace verdigris
