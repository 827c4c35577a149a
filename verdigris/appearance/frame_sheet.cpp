// SPDX-License-Identifier: MIT
#include "verdigris/appearance/frame_sheet.h"

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

constexpr int kHeader = 118, kFooter = 76, kNameWidth = 170;
constexpr int kTrainedFor = 10;  // the paper's K: what lies beyond it is marked, as there

void pair_of(SheetCanvas& canvas, int x, int y, const ExampleFrame& f, int factor, double full) {
    tile(canvas, x, y, enlarged(f.picture, factor));
    tile(canvas, x, y + f.picture.height() * factor + 2, magma(enlarged(f.change, factor), full));
}

}  // namespace

Image<SrgbU8> draw_frame_sheet(const MaterialJudgment& judgment, std::size_t direction) {
    if (direction >= judgment.directions.size() || judgment.directions[direction].examples.empty())
        throw Error(ErrorCode::usage, "no window was judged, so there is nothing to look at");
    const MaterialDirection& d = judgment.directions[direction];
    const MaterialExample& first = d.examples.front();
    std::vector<const Image<float>*> maps;
    for (const MaterialExample& e : d.examples) {
        maps.push_back(&e.true_frame.change);
        for (const ExampleRow& r : e.rows) maps.push_back(&r.frame.change);
    }
    const double full = full_scale(maps);
    const int factor = zoom(first.last.width());
    const int wide = first.last.width() * factor, high = first.last.height() * factor;
    const int left = std::max(wide, kNameWidth);
    const int row_height = 2 * high + 2 + 2 * kGap;
    // Of the controls only the truth is drawn: holding still is the first column.
    const std::size_t entrants = first.rows.size() - MaterialDirection::kControls;
    // Wide enough for the sentences, however few the horizons.
    constexpr int kLeastWidth = 680;
    const int width =
        std::max(2 * kMargin + left + int(d.examples.size()) * (wide + kGap), kLeastWidth);
    SheetCanvas canvas(width, kHeader + int(entrants + 1) * row_height + kFooter, kGround);
    put(canvas, kMargin, 44, width - 2 * kMargin, "Forecast and true frames: " + d.label, kTitle);
    put(canvas, kMargin, 74, width - 2 * kMargin,
        fmt::format("Window from sample {}; below each frame how far it is from the last observed",
                    first.start),
        kLabel);
    put(canvas, kMargin, 104, wide, "LAST FRAME", kHeading);
    tile(canvas, kMargin, kHeader, enlarged(first.last, factor));
    for (std::size_t h = 0; h < d.examples.size(); ++h) {
        const MaterialExample& e = d.examples[h];
        const int x = kMargin + left + kGap + int(h) * (wide + kGap);
        put(canvas, x, 104, wide,
            fmt::format("+{}{}", e.horizon, e.horizon > kTrainedFor ? "*" : ""), kHeading);
        pair_of(canvas, x, kHeader, e.true_frame, factor, full);
        for (std::size_t i = 0; i < entrants; ++i) {
            const ExampleRow& r = e.rows[MaterialDirection::kControls + i];
            pair_of(canvas, x, kHeader + int(i + 1) * row_height, r.frame, factor, full);
        }
    }
    const auto name = [&](std::size_t row, const std::string& text) {
        put(canvas, kMargin, kHeader + int(row) * row_height + high + 24, left, text, kLabel);
    };
    name(0, "true frames");
    for (std::size_t i = 0; i < entrants; ++i)
        name(i + 1, first.rows[MaterialDirection::kControls + i].name);
    const int below = kHeader + int(entrants + 1) * row_height;
    scale_of_colors(canvas, kMargin, below + 16, "mean |frame - last observed| of a pixel", full);
    if (d.examples.back().horizon > kTrainedFor)
        put(canvas, kMargin, below + 54, width - 2 * kMargin,
            fmt::format("* beyond +{}: further than the networks were trained for", kTrainedFor),
            kSmall);
    return canvas.pixels();
}

}  // namespace verdigris
