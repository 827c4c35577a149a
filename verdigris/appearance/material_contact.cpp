// SPDX-License-Identifier: MIT
#include "verdigris/appearance/material_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "verdigris/color/magma.h"
#include "verdigris/deliver/sheet_canvas.h"
#include "verdigris/deliver/text_wrap.h"
#include "verdigris/deliver/visible_change.h"
#include "verdigris/error.h"

namespace verdigris {
namespace {

// The ground of deliver's contact sheet: neutral, so that it does not tint the judgment of copper.
constexpr Ink kGround{0x1D1F21}, kText{0xECEAE6}, kMuted{0x9DA3A8}, kRule{0x3A3E42};
constexpr TextStyle kTitle{24, kText, true}, kHeading{14, kMuted, true}, kLabel{15, kText},
    kSmall{13, kMuted};
constexpr int kMargin = 28, kGap = 8, kBetween = 40, kHeader = 118, kRowText = 26, kFooter = 54;

void put(SheetCanvas& canvas, double x, double y, double width, const std::string& text,
         const TextStyle& style) {
    canvas.text(x, y, ellipsized(printable(text), width, measure(style)), style);
}

void tile(SheetCanvas& canvas, int x, int y, const Image<SrgbU8>& picture) {
    canvas.picture(x, y, picture.view());
    canvas.frame({x, y, picture.width(), picture.height()}, kRule);
}

double full_scale(const std::vector<const MaterialExample*>& examples) {
    std::vector<float> all;
    for (const MaterialExample* e : examples)
        for (const ExampleRow& r : e->rows)
            all.insert(all.end(), r.flip.pixels().begin(), r.flip.pixels().end());
    const auto rank = std::ptrdiff_t(0.995 * double(all.size() - 1));
    std::ranges::nth_element(all, all.begin() + rank);
    return round_scale(double(all[std::size_t(rank)]));
}

void draw_scale(SheetCanvas& canvas, int x, int y, double full) {
    constexpr int kWidth = 240, kHeight = 12;
    Image<float> ramp(kWidth, kHeight);
    for (int row = 0; row < kHeight; ++row)
        for (int i = 0; i < kWidth; ++i) ramp(i, row) = (float(i) + 0.5f) / kWidth;
    tile(canvas, x, y, magma(ramp, 1));
    canvas.text(x + kWidth + 12, y + 11,
                fmt::format("FLIP per pixel, 0 to {:g}{}", full, full < 1 ? " or more" : ""),
                kSmall);
}

}  // namespace

Image<SrgbU8> draw_material_contact(const MaterialJudgment& judgment, std::size_t horizon) {
    std::vector<const MaterialExample*> examples;
    std::vector<const MaterialDirection*> directions;
    std::size_t rows = 0;
    for (const MaterialDirection& d : judgment.directions) {
        if (horizon >= d.examples.size()) continue;
        examples.push_back(&d.examples[horizon]);
        directions.push_back(&d);
        rows = std::max(rows, d.rows.size());
    }
    if (examples.empty())
        throw Error(ErrorCode::usage, "no window was judged, so there is nothing to look at");
    const int side = judgment.options.view.size;
    const int column = 3 * side + 2 * kGap;
    const int width = 2 * kMargin + int(examples.size()) * (column + kBetween) - kBetween;
    const int height = kHeader + int(rows) * (side + kRowText + kGap) + kFooter;
    SheetCanvas canvas(width, height, kGround);
    const int unit = judgment.options.horizons[horizon];
    put(canvas, kMargin, 44, width - 2 * kMargin, fmt::format("Materials at +{} units", unit),
        kTitle);
    const double full = full_scale(examples);
    for (std::size_t i = 0; i < examples.size(); ++i) {
        const int x = kMargin + int(i) * (column + kBetween);
        const MaterialExample& e = *examples[i];
        put(canvas, x, 74, column,
            fmt::format("{}, window from sample {}", directions[i]->label, e.start), kLabel);
        const char* kHeadings[] = {"FORECAST", "TRUE FUTURE", "FLIP"};
        for (int k = 0; k < 3; ++k) canvas.text(x + k * (side + kGap), 104, kHeadings[k], kHeading);
        for (std::size_t row = 0; row < e.rows.size(); ++row) {
            const ExampleRow& r = e.rows[row];
            const int y = kHeader + int(row) * (side + kRowText + kGap);
            tile(canvas, x, y, r.picture);
            tile(canvas, x + side + kGap, y, e.truth);
            tile(canvas, x + 2 * (side + kGap), y, magma(r.flip, full));
            put(canvas, x, y + side + 19, column,
                fmt::format("{}{}: mean FLIP {:.4f}", r.name,
                            row == 0   ? " (static control)"
                            : row == 2 ? " (old color, true maps: no forecast)"
                                       : "",
                            r.mean),
                kLabel);
        }
    }
    draw_scale(canvas, kMargin, height - 34, full);
    return canvas.pixels();
}

}  // namespace verdigris
