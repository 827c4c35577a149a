// SPDX-License-Identifier: MIT
// What the sheets of this room have in common (internal): ink, tiles, and a scale for maps.
#pragma once

#include <string>
#include <vector>

#include "verdigris/deliver/sheet_canvas.h"
#include "verdigris/pixels/image.h"

namespace verdigris::sheet {

// The ground of deliver's contact sheet: neutral, so that it does not tint the judgment of copper.
constexpr Ink kGround{0x1D1F21}, kText{0xECEAE6}, kMuted{0x9DA3A8}, kRule{0x3A3E42};
constexpr TextStyle kTitle{24, kText, true}, kHeading{14, kMuted, true}, kLabel{15, kText},
    kSmall{13, kMuted};
constexpr int kMargin = 28, kGap = 8, kBetween = 40;

/// Cut to `width`.
void put(SheetCanvas& canvas, double x, double y, double width, const std::string& text,
         const TextStyle& style);

/// How often a picture's pixels are repeated so that it is wide enough to have words below it.
int zoom(int side);
/// Each pixel `factor` times in both directions.
template <class Pixel>
Image<Pixel> enlarged(const Image<Pixel>& image, int factor) {
    auto out = Image<Pixel>::for_overwrite(image.width() * factor, image.height() * factor);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x) out(x, y) = image(x / factor, y / factor);
    return out;
}

void tile(SheetCanvas& canvas, int x, int y, const Image<SrgbU8>& picture);
/// A ramp with what it means, from 0 to `full`.
void scale_of_colors(SheetCanvas& canvas, int x, int y, const std::string& what, double full);
/// The 99.5th percentile of them all, through round_scale(). There is at least one pixel.
double full_scale(const std::vector<const Image<float>*>& maps);

}  // namespace verdigris::sheet
