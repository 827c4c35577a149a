// SPDX-License-Identifier: MIT
#include "verdigris/appearance/sheet_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "verdigris/color/magma.h"
#include "verdigris/deliver/text_wrap.h"
#include "verdigris/deliver/visible_change.h"

namespace verdigris::sheet {

void put(SheetCanvas& canvas, double x, double y, double width, const std::string& text,
         const TextStyle& style) {
    canvas.text(x, y, ellipsized(printable(text), width, measure(style)), style);
}

int zoom(int side) {
    constexpr int kReadable = 128;
    return std::max(1, (kReadable + side - 1) / side);
}

void tile(SheetCanvas& canvas, int x, int y, const Image<SrgbU8>& picture) {
    canvas.picture(x, y, picture.view());
    canvas.frame({x, y, picture.width(), picture.height()}, kRule);
}

void scale_of_colors(SheetCanvas& canvas, int x, int y, const std::string& what, double full) {
    constexpr int kWidth = 240, kHeight = 12;
    Image<float> ramp(kWidth, kHeight);
    for (int row = 0; row < kHeight; ++row)
        for (int i = 0; i < kWidth; ++i) ramp(i, row) = (float(i) + 0.5f) / kWidth;
    tile(canvas, x, y, magma(ramp, 1));
    canvas.text(x + kWidth + 12, y + 11,
                fmt::format("{}, 0 to {:g}{}", what, full, full < 1 ? " or more" : ""), kSmall);
}

double full_scale(const std::vector<const Image<float>*>& maps) {
    std::vector<float> all;
    for (const Image<float>* map : maps)
        all.insert(all.end(), map->pixels().begin(), map->pixels().end());
    const auto rank = std::ptrdiff_t(0.995 * double(all.size() - 1));
    std::ranges::nth_element(all, all.begin() + rank);
    return round_scale(double(all[std::size_t(rank)]));
}

}  // namespace verdigris::sheet
