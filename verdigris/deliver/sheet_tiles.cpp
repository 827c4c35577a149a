// SPDX-License-Identifier: MIT
#include "verdigris/deliver/sheet_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "verdigris/color/convert.h"
#include "verdigris/color/magma.h"
#include "verdigris/deliver/uncertainty.h"
#include "verdigris/deliver/uncertainty_map.h"

namespace verdigris {
namespace {

// chosen: what fits on a sheet that is still read at a glance.
constexpr int kMaxObserved = 5, kMaxForecast = 6;

Image<SrgbU8> tile_of(const Image<SrgbF>& image) {
    const Image<SrgbF> small = resampled(image, tile_extent({image.width(), image.height()}));
    Image<SrgbU8> picture = Image<SrgbU8>::for_overwrite(small.width(), small.height());
    std::transform(small.pixels().begin(), small.pixels().end(), picture.pixels().begin(),
                   [](SrgbF c) { return u8_from_srgb(c); });
    return picture;
}

// Data shown as gray: the value is the code value, as an image editor would show the file.
Image<SrgbU8> tile_of(const Image<float>& map) {
    Image<SrgbF> gray = Image<SrgbF>::for_overwrite(map.width(), map.height());
    std::transform(map.pixels().begin(), map.pixels().end(), gray.pixels().begin(), [](float v) {
        return SrgbF{v, v, v};
    });
    return tile_of(gray);
}

Image<SrgbU8> tile_of(const Image<Vec3F>& normal) {
    Image<SrgbF> shown = Image<SrgbF>::for_overwrite(normal.width(), normal.height());
    std::transform(normal.pixels().begin(), normal.pixels().end(), shown.pixels().begin(),
                   [](Vec3F n) {
                       return SrgbF{n.x * 0.5f + 0.5f, n.y * 0.5f + 0.5f, n.z * 0.5f + 0.5f};
                   });
    return tile_of(shown);
}

void add_observed(const Delivery& delivery, const Image<SrgbF>& base, SheetTiles& tiles) {
    if (delivery.observed.empty()) {
        tiles.observed.push_back({"last observed", tile_of(base)});
        return;
    }
    for (int index : evenly_chosen(int(delivery.observed.size()), kMaxObserved)) {
        const ObservedFrame& frame = delivery.observed[std::size_t(index)];
        tiles.observed.push_back(
            {frame.unit == 0 ? std::string("last observed") : fmt::format("{:+.4g} u", frame.unit),
             tile_of(frame.image)});
    }
}

void add_forecast(const Delivery& delivery, const Image<SrgbF>& base, SheetTiles& tiles,
                  const Progress& progress) {
    static const Mask kEverywhere;
    const Mask& where = delivery.specimen ? *delivery.specimen : kEverywhere;
    const std::vector<int> shown = evenly_chosen(int(delivery.horizons.size()), kMaxForecast);
    std::vector<Image<float>> changes;
    for (int index : shown) {
        report(progress, "deliver", std::int64_t(changes.size()), std::int64_t(shown.size()) + 1);
        const double horizon = delivery.horizons[std::size_t(index)];
        const Image<SrgbF> frame = delivery.forecast->at(horizon);
        ForecastTile tile;
        tile.label = fmt::format("{:+g} u", horizon);
        tile.picture = tile_of(frame);
        tile.beyond_trust = horizon > 2.0 * delivery.forecast->context_length;
        changes.push_back(change_between(base, frame));
        tile.mean_change = mean_inside(changes.back(), where);
        tiles.forecast.push_back(std::move(tile));
    }
    tiles.change_scale = change_scale(changes, where);
    for (std::size_t i = 0; i < changes.size(); ++i) {
        const Image<float>& change = changes[i];
        tiles.forecast[i].change = magma(
            resampled(change, tile_extent({change.width(), change.height()})), tiles.change_scale);
    }
    tiles.change_scale_note =
        "Mean of the absolute differences in R, G and B, in % of full scale (encoded sRGB); the "
        "mean is over the specimen.";
    if (shown.size() < delivery.horizons.size()) {
        tiles.change_scale_note +=
            fmt::format(" Shown: {} of {} horizons.", shown.size(), delivery.horizons.size());
    }
}

// After add_forecast(): of the same horizons.
void add_uncertainty(const Delivery& delivery, SheetTiles& tiles) {
    const Spread& spread = delivery.forecast->spread;
    const std::vector<Uncertainty> told = uncertainty_of(delivery);
    if (told.empty()) return;
    const std::vector<int> shown = evenly_chosen(int(told.size()), kMaxForecast);
    const Image<float> share = own_share(spread, tile_extent(tiles.picture));
    tiles.uncertainty_full_codes = uncertainty_full_codes(delivery);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const Uncertainty& u = told[std::size_t(shown[i])];
        ForecastTile& tile = tiles.forecast[i];
        tile.uncertainty = uncertainty_picture(half_width_map(spread, share, u.horizon), share,
                                               tiles.uncertainty_full_codes / 255);
        tile.pixel_80 = u.pixel80;
    }
    tiles.uncertainty_note =
        "Nominal half width for a pixel, root mean square of R, G and B, in codes of 255 (encoded "
        "sRGB). The number is that of all pixels. Gray: held, no interval.";
}

void add_maps(const Delivery& delivery, SheetTiles& tiles) {
    const double horizon = trusted_horizon(delivery);
    Material material;
    materialize(*delivery.recipe, *delivery.forecast, horizon, material);
    const std::vector<MapOrigin> origins =
        map_origins(*delivery.forecast, delivery.recipe->observed_is_clean);
    const auto add = [&](const char* name, const char* map, Image<SrgbU8> picture) {
        tiles.maps.push_back({name, origin_of(origins, map), std::move(picture)});
    };
    add("Albedo", "albedo", tile_of(material.albedo));
    add("Normal (+Y up)", "normal", tile_of(material.normal));
    add("Roughness", "roughness", tile_of(material.roughness));
    add("Metallic", "metallic", tile_of(material.metallic));
    add("Height", "height", tile_of(material.height));
    add("Patina coverage", "coverage", tile_of(material.coverage));
    tiles.maps_heading = horizon > 0 ? fmt::format("MATERIAL AT {:+g} u", horizon)
                                     : std::string("MATERIAL OF THE LAST OBSERVED FRAME");
}

}  // namespace

SheetTiles make_sheet_tiles(const Delivery& delivery, const Progress& progress) {
    delivered_states(delivery);  // throws if the delivery is not complete
    const Image<SrgbF> base = delivery.forecast->at(0);
    SheetTiles tiles;
    tiles.picture = {base.width(), base.height()};
    add_observed(delivery, base, tiles);
    add_forecast(delivery, base, tiles, progress);
    add_uncertainty(delivery, tiles);
    add_maps(delivery, tiles);
    return tiles;
}

}  // namespace verdigris
