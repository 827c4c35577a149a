// SPDX-License-Identifier: MIT
// The pictures of a contact sheet, at tile size, with their labels.
#pragma once

#include <string>
#include <vector>

#include "verdigris/deliver/delivery.h"
#include "verdigris/deliver/sheet_layout.h"
#include "verdigris/deliver/visible_change.h"
#include "verdigris/progress.h"

namespace verdigris {

struct ObservedTile {
    std::string label;
    Image<SrgbU8> picture;
};
struct ForecastTile {
    std::string label;
    Image<SrgbU8> picture, change;
    Image<SrgbU8> uncertainty;  ///< empty where none is stated
    double mean_change = 0;     ///< over the specimen; 1 is full scale
    double pixel_80 = 0;        ///< half width, root mean square of the pixels; 1 is full scale
    bool beyond_trust = false;  ///< further than twice the context
};
struct MapTile {
    std::string name;
    Origin origin{};
    Image<SrgbU8> picture;
};

struct SheetTiles {
    PictureSize picture;
    std::vector<ObservedTile> observed;
    std::vector<ForecastTile> forecast;
    std::vector<MapTile> maps;
    double change_scale = 1;
    double uncertainty_full_codes = 0;  ///< 0: none is stated
    std::string change_scale_note, uncertainty_note, maps_heading;
};

/// At most 5 observed frames and 6 horizons, evenly chosen; the maps of trusted_horizon().
SheetTiles make_sheet_tiles(const Delivery& delivery, const Progress& progress = {});

}  // namespace verdigris
