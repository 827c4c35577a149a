// SPDX-License-Identifier: MIT
#include "verdigris/deliver/sheet_layout.h"

#include <algorithm>
#include <cmath>

namespace verdigris {
namespace {

// chosen, all by looking at sheets: distances in pixels.
constexpr int kMargin = 64;
constexpr int kGap = 24;         // between tiles
constexpr int kDividerGap = 72;  // between the last observed frame and the first forecast
constexpr int kMinColumn = 184;  // room for a label under a narrow tile
constexpr int kHeadingToTile = 18;
constexpr int kLabels = 60;         // two lines under a tile
constexpr int kRowGap = 56;         // from labels to the next heading's baseline
constexpr int kLegendHeight = 148;  // color bar, ticks, three lines
constexpr int kMinNotes = 560;      // narrower, and the notes go below
constexpr int kMinWidth = 1280;
constexpr int kLegendWidth = 340;
constexpr int kMinChart = 420;     // narrower, it says nothing
constexpr int kChartHeight = 190;  // at least; else as high as a tile

int columns_width(int columns, int column) {
    return columns > 0 ? columns * column + (columns - 1) * kGap : 0;
}

std::vector<Rect> tiles(int count, int x, int y, int column, PictureSize tile) {
    std::vector<Rect> result;
    for (int i = 0; i < count; ++i) {
        result.push_back({x + i * (column + kGap), y, tile.width, tile.height});
    }
    return result;
}

}  // namespace

PictureSize tile_extent(PictureSize picture) {
    const int side = std::max({picture.width, picture.height, 1});
    const auto scaled = [&](int length) {
        return std::max(1, int(std::lround(double(length) * kTileSide / side)));
    };
    return {scaled(picture.width), scaled(picture.height)};
}

std::vector<int> evenly_chosen(int count, int limit) {
    std::vector<int> indices;
    const int n = std::min(count, limit);
    for (int i = 0; i < n; ++i) {
        indices.push_back(n == 1 ? count - 1 : int(std::lround(double(i) * (count - 1) / (n - 1))));
    }
    return indices;
}

SheetLayout lay_out(const SheetContent& content) {
    SheetLayout s;
    s.margin = kMargin;
    s.tile = tile_extent(content.picture);
    s.column_width = std::max(s.tile.width, kMinColumn);
    const int column = s.column_width;

    s.title_y = kMargin + 36;
    s.facts_y = s.title_y + 36;
    s.axis_y = s.facts_y + 28;
    s.rule_y = s.axis_y + 28;

    // The legend of the change maps stands under the observed frames, so their block is never
    // narrower than two columns.
    const int seen_width =
        std::max(columns_width(content.observed, column), columns_width(2, column));
    const int forecast_x = kMargin + seen_width + kDividerGap;
    s.frames_heading_y = s.rule_y + 48;
    const int frames_y = s.frames_heading_y + kHeadingToTile;
    s.observed = tiles(content.observed, kMargin, frames_y, column, s.tile);
    s.forecast = tiles(content.forecast, forecast_x, frames_y, column, s.tile);

    s.change_heading_y = frames_y + s.tile.height + kLabels + kRowGap;
    const int change_y = s.change_heading_y + kHeadingToTile;
    s.change = tiles(content.forecast, forecast_x, change_y, column, s.tile);
    s.legend = {kMargin, change_y, std::min(seen_width, kLegendWidth), kLegendHeight};
    const int chart_x = s.legend.x + s.legend.width + kDividerGap;
    if (const int width = kMargin + seen_width - chart_x; width >= kMinChart) {
        s.chart = {chart_x, change_y, width, std::max(s.tile.height, kChartHeight)};
    }
    int bottom = change_y + std::max({s.tile.height + kLabels, kLegendHeight, s.chart.height});
    if (content.uncertainty && content.forecast > 0) {
        s.uncertainty_heading_y = bottom + kRowGap;
        const int y = s.uncertainty_heading_y + kHeadingToTile;
        s.uncertainty = tiles(content.forecast, forecast_x, y, column, s.tile);
        s.uncertainty_legend = {kMargin, y, s.legend.width, kLegendHeight};
        bottom = y + std::max(s.tile.height + kLabels, kLegendHeight);
    }

    s.divider_x = kMargin + seen_width + kDividerGap / 2;
    s.divider_top = s.frames_heading_y - 16;
    s.divider_bottom = bottom;

    s.maps_heading_y = bottom + kRowGap;
    const int maps_y = s.maps_heading_y + kHeadingToTile;
    s.maps = tiles(content.maps, kMargin, maps_y, column, s.tile);
    s.maps_bottom = maps_y + s.tile.height + kLabels;

    const int maps_width = columns_width(content.maps, column);
    const int row_width = seen_width + kDividerGap + columns_width(content.forecast, column);
    s.width = std::max({kMinWidth, row_width + 2 * kMargin, maps_width + 2 * kMargin});
    const int notes_x = kMargin + maps_width + kDividerGap;
    if (s.width - kMargin - notes_x >= kMinNotes) {
        s.notes = {notes_x, s.maps_heading_y, s.width - kMargin - notes_x, 0};
    } else {
        s.notes = {kMargin, s.maps_bottom + kRowGap, s.width - 2 * kMargin, 0};
    }
    return s;
}

}  // namespace verdigris
