// SPDX-License-Identifier: MIT
#include "verdigris/appearance/material_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "verdigris/appearance/sheet_parts.h"
#include "verdigris/color/magma.h"
#include "verdigris/error.h"

namespace verdigris {
namespace {

using namespace sheet;

constexpr int kHeader = 118, kRowText = 26, kFooter = 54;

double flip_scale(const std::vector<const MaterialExample*>& examples) {
    std::vector<const Image<float>*> maps;
    for (const MaterialExample* e : examples)
        for (const ExampleRow& r : e->rows) maps.push_back(&r.flip);
    return full_scale(maps);
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
    const int factor = zoom(judgment.options.view.size);
    const int side = judgment.options.view.size * factor;
    const int column = 3 * side + 2 * kGap;
    const int width = 2 * kMargin + int(examples.size()) * (column + kBetween) - kBetween;
    const int height = kHeader + int(rows) * (side + kRowText + kGap) + kFooter;
    SheetCanvas canvas(width, height, kGround);
    const int unit = judgment.options.horizons[horizon];
    put(canvas, kMargin, 44, width - 2 * kMargin, fmt::format("Materials at +{} units", unit),
        kTitle);
    const double full = flip_scale(examples);
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
            tile(canvas, x, y, enlarged(r.picture, factor));
            tile(canvas, x + side + kGap, y, enlarged(e.truth, factor));
            tile(canvas, x + 2 * (side + kGap), y, magma(enlarged(r.flip, factor), full));
            put(canvas, x, y + side + 19, column,
                fmt::format("{}{}: mean FLIP {:.4f}", r.name,
                            row == 0   ? " (static control)"
                            : row == 2 ? " (old color, true maps: no forecast)"
                                       : "",
                            r.mean),
                kLabel);
        }
    }
    scale_of_colors(canvas, kMargin, height - 34, "FLIP per pixel", full);
    return canvas.pixels();
}

}  // namespace verdigris
