// SPDX-License-Identifier: MIT
#include "verdigris/deliver/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verdigris/color/magma.h"
#include "verdigris/deliver/sheet_canvas.h"
#include "verdigris/deliver/sheet_chart.h"
#include "verdigris/deliver/sheet_layout.h"
#include "verdigris/deliver/sheet_notes.h"
#include "verdigris/deliver/sheet_tiles.h"
#include "verdigris/deliver/source_type.h"
#include "verdigris/deliver/uncertainty.h"
#include "verdigris/files/png.h"

namespace verdigris {
namespace {

// chosen: a neutral dark ground, so that it does not tint the eye's judgment of copper; one accent
// (verdigris) means "forecast", amber means "take care".
constexpr Ink kGround{0x1D1F21}, kText{0xECEAE6}, kMuted{0x9DA3A8}, kRule{0x3A3E42},
    kForecast{0x6FD0B4}, kAmber{0xE6B450};
constexpr Ink kMeasured{0x9BCF8E}, kModeled{0x8AB6E8}, kAssumed{0xE6B450};

constexpr TextStyle kTitle{38, kText, true}, kFacts{18, kText}, kAxis{16, kMuted},
    kHeading{14, kMuted, true}, kLabel{17, kText}, kSmall{15, kMuted}, kFooter{14, kMuted};

TextStyle inked(TextStyle style, Ink ink) {
    style.ink = ink;
    return style;
}

// Draws `text` shortened to `width`.
void put(SheetCanvas& canvas, double x, double y, double width, const std::string& text,
         const TextStyle& style) {
    canvas.text(x, y, ellipsized(printable(text), width, measure(style)), style);
}

void draw_header(SheetCanvas& canvas, const Delivery& delivery, const SheetLayout& s) {
    const double width = s.width - 2 * s.margin;
    put(canvas, s.margin, s.title_y, width, delivery.title, kTitle);
    put(canvas, s.margin, s.facts_y, width,
        fmt::format("Forecaster: {}  \xC2\xB7  context: the last n = {} frames  \xC2\xB7  {:.4g} "
                    "units observed",
                    delivery.forecast->forecaster, delivery.forecast->context_length,
                    delivery.units_observed),
        kFacts);
    put(canvas, s.margin, s.axis_y, width,
        "Forecast axis: accelerated units (u), shares of the observed recording; not calendar "
        "time.",
        kAxis);
    canvas.line(s.margin, s.rule_y, s.width - s.margin, s.rule_y, kRule, 1, false);
}

void draw_tile(SheetCanvas& canvas, const Rect& at, const Image<SrgbU8>& picture) {
    canvas.picture(at.x, at.y, picture.view());
    canvas.frame(at, kRule);
}

void draw_frames(SheetCanvas& canvas, const SheetLayout& s, const SheetTiles& tiles) {
    const double label_y = s.tile.height + 26.0;
    canvas.text(s.margin, s.frames_heading_y, "OBSERVED", kHeading);
    for (std::size_t i = 0; i < tiles.observed.size(); ++i) {
        const Rect& at = s.observed[i];
        draw_tile(canvas, at, tiles.observed[i].picture);
        put(canvas, at.x, at.y + label_y, s.column_width, tiles.observed[i].label, kLabel);
    }
    if (tiles.forecast.empty()) return;
    canvas.text(s.forecast[0].x, s.frames_heading_y, "FORECAST", inked(kHeading, kForecast));
    for (std::size_t i = 0; i < tiles.forecast.size(); ++i) {
        const ForecastTile& tile = tiles.forecast[i];
        const Rect& at = s.forecast[i];
        draw_tile(canvas, at, tile.picture);
        put(canvas, at.x, at.y + label_y, s.column_width, tile.label, inked(kLabel, kForecast));
        if (tile.beyond_trust) {
            put(canvas, at.x, at.y + label_y + 23, s.column_width, "beyond 2 n: see notes",
                inked(kSmall, kAmber));
        }
        draw_tile(canvas, s.change[i], tile.change);
        put(canvas, at.x, s.change[i].y + label_y, s.column_width,
            fmt::format("mean {:.2g} %", 100 * tile.mean_change), kLabel);
        if (s.uncertainty.empty()) continue;
        draw_tile(canvas, s.uncertainty[i], tile.uncertainty);
        put(canvas, at.x, s.uncertainty[i].y + label_y, s.column_width,
            codes_text(tile.pixel_80) + " codes of 255", kLabel);
    }
    // "Now": where photographs end.
    const std::string now = "now";
    const TextStyle style = inked(kHeading, kGround);
    const double now_width = text_width(now, style);
    canvas.line(s.divider_x, s.divider_top, s.divider_x, s.divider_bottom, kForecast, 1.5, true);
    const int half = int(std::ceil(now_width / 2)) + 10;
    canvas.fill({s.divider_x - half, s.frames_heading_y - 17, 2 * half, 24}, kForecast, 12);
    canvas.text(s.divider_x - now_width / 2, s.frames_heading_y, now, style);
}

struct Legend {
    std::string heading;
    std::string half, full;  ///< of the scale, as they stand under the bar
    std::string note;
};

void draw_legend(SheetCanvas& canvas, const Rect& at, int heading_y, const Legend& legend) {
    canvas.text(at.x, heading_y, legend.heading, kHeading);
    const int bar_width = std::min(at.width, 320), bar_height = 16;
    Image<float> ramp(bar_width, bar_height);
    for (int y = 0; y < bar_height; ++y) {
        for (int x = 0; x < bar_width; ++x) {
            ramp(x, y) = (float(x) + 0.5f) / float(bar_width);
        }
    }
    const Rect bar{at.x, at.y, bar_width, bar_height};
    draw_tile(canvas, bar, magma(ramp, 1));
    const TextWidth width = measure(kSmall);
    const double tick_y = at.y + bar_height + 22;
    canvas.text(at.x, tick_y, "0", kSmall);
    canvas.text(at.x + bar_width / 2.0 - width(legend.half) / 2, tick_y, legend.half, kSmall);
    // Right-aligned where there is room, so that the label stays under the bar.
    canvas.text(at.x + bar_width - width(legend.full), tick_y, legend.full, kSmall);
    double y = tick_y + 34;
    for (const std::string& line : wrapped(legend.note, at.width, 5, width)) {
        canvas.text(at.x, y, line, kSmall);
        y += 22;
    }
}

void draw_legends(SheetCanvas& canvas, const SheetLayout& s, const SheetTiles& tiles) {
    const double percent = 100 * tiles.change_scale, codes = tiles.uncertainty_full_codes;
    draw_legend(canvas, s.legend, s.change_heading_y,
                {"CHANGE FROM LAST OBSERVED", fmt::format("{:g}", percent / 2),
                 fmt::format("{:g} % or more", percent), tiles.change_scale_note});
    if (s.uncertainty.empty()) return;
    draw_legend(canvas, s.uncertainty_legend, s.uncertainty_heading_y,
                {"HOW FAR OFF, 4 TIMES IN 5", fmt::format("{:g}", codes / 2),
                 fmt::format("{:g} or more", codes), tiles.uncertainty_note});
}

Ink ink_of(Origin origin) {
    switch (origin) {
        case Origin::measured:
            return kMeasured;
        case Origin::modeled:
            return kModeled;
        case Origin::assumed:
            return kAssumed;
    }
    return kModeled;
}

void draw_maps(SheetCanvas& canvas, const SheetLayout& s, const SheetTiles& tiles) {
    put(canvas, s.margin, s.maps_heading_y, s.width - 2 * s.margin, tiles.maps_heading, kHeading);
    for (std::size_t i = 0; i < tiles.maps.size(); ++i) {
        const MapTile& map = tiles.maps[i];
        const Rect& at = s.maps[i];
        draw_tile(canvas, at, map.picture);
        const int label_y = at.y + at.height + 26;
        put(canvas, at.x, label_y, s.column_width, map.name, kLabel);
        canvas.fill({at.x, label_y + 13, 10, 10}, ink_of(map.origin), 5);
        put(canvas, at.x + 18, label_y + 23, s.column_width - 18, to_string(map.origin), kSmall);
    }
}

}  // namespace

Image<SrgbU8> draw_contact_sheet(const Delivery& delivery, const Progress& progress) {
    const SheetTiles tiles = make_sheet_tiles(delivery, progress);
    const SheetLayout s =
        lay_out({tiles.picture, int(tiles.observed.size()), int(tiles.forecast.size()),
                 int(tiles.maps.size()), tiles.uncertainty_full_codes > 0});
    const SheetNotes notes(delivery, s.notes.width);
    const int footer_y = std::max(s.maps_bottom, s.notes.y + notes.height()) + 56;

    SheetCanvas canvas(s.width, footer_y + s.margin - 8, kGround);
    draw_header(canvas, delivery, s);
    draw_frames(canvas, s, tiles);
    draw_legends(canvas, s, tiles);
    if (s.chart.width > 0) {
        canvas.text(s.chart.x, s.change_heading_y, "MEAN CHANGE, BY UNITS", kHeading);
        draw_chart(canvas, s.chart, change_curve(delivery));
    }
    draw_maps(canvas, s, tiles);
    notes.draw(canvas, s.notes.x, s.notes.y);
    const Forecast& forecast = *delivery.forecast;
    const bool held = forecast.is_trajectory() && forecast.trajectory.law.order == 0;
    canvas.line(s.margin, footer_y - 30, s.width - s.margin, footer_y - 30, kRule, 1, false);
    put(canvas, s.margin, footer_y, s.width - 2 * s.margin,
        fmt::format(
            "{} computed, not photographed.  \xC2\xB7  verdigris {}",
            held ? "The forecast is the last observed frame, held; all maps but the albedo are"
                 : "Forecast frames and all maps are",
            writer_version()),
        kFooter);
    return canvas.pixels();
}

void write_contact_sheet(const Delivery& delivery, const std::filesystem::path& file,
                         const Progress& progress) {
    write_png(file, draw_contact_sheet(delivery, progress),
              png_options(SourceType::composite_synthetic, 6));
    report(progress, "deliver", 1, 1);
}

}  // namespace verdigris
