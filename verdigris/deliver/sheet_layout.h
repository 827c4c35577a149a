// SPDX-License-Identifier: MIT
// Where everything stands on a contact sheet. Pure arithmetic, so that "nothing overlaps" is a
// test.
#pragma once

#include <vector>

#include "verdigris/deliver/resample.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// chosen: 256 px tiles show the texture of a specimen and keep a sheet of ten columns below
/// 3000 px.
inline constexpr int kTileSide = 256;

struct SheetContent {
    PictureSize picture;  ///< size of one frame
    int observed = 0, forecast = 0, maps = 0;
    bool uncertainty = false;  ///< a row of maps of it, one per forecast frame
};

/// All in pixels of the sheet. Text lines are given by their baselines.
struct SheetLayout {
    PictureSize tile;
    int width = 0;  ///< of the sheet
    int margin = 0;
    int title_y = 0, facts_y = 0, axis_y = 0, rule_y = 0;
    int frames_heading_y = 0, change_heading_y = 0, uncertainty_heading_y = 0, maps_heading_y = 0;
    std::vector<Rect> observed, forecast;  ///< tiles of row 1
    std::vector<Rect> change;              ///< row 2, each under its forecast frame
    std::vector<Rect> uncertainty;         ///< row 3, likewise; empty if there is none
    std::vector<Rect> maps;                ///< the last row
    int column_width = 0;                  ///< for labels: at least as wide as a tile
    int divider_x = 0, divider_top = 0, divider_bottom = 0;
    Rect legend;              ///< of the change maps, left of them
    Rect chart;               ///< right of the legend; empty if there is no room
    Rect uncertainty_legend;  ///< empty without the row
    Rect notes;               ///< height 0: as long as the text needs
    int maps_bottom = 0;      ///< below the labels of the maps
};

/// The tile of a picture: its long side is kTileSide.
PictureSize tile_extent(PictureSize picture);
SheetLayout lay_out(const SheetContent& content);

/// At most `limit` indices out of `count`, evenly spread, the first and the last among them.
std::vector<int> evenly_chosen(int count, int limit);

}  // namespace verdigris
