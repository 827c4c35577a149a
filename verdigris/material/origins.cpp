// SPDX-License-Identifier: MIT
#include "verdigris/material/material.h"

namespace verdigris {

std::string to_string(Origin origin) {
    switch (origin) {
        case Origin::measured:
            return "measured";
        case Origin::modeled:
            return "modeled";
        case Origin::assumed:
            return "assumed";
    }
    return "unknown";
}

std::vector<MapOrigin> map_origins(const Forecast& forecast, bool observed_is_clean,
                                   MapsOf maps_of) {
    const std::string clean =
        observed_is_clean ? "the observed state" : "the start of the recording";
    const bool held = forecast.is_trajectory() && forecast.trajectory.law.order == 0;
    const bool photographed = held || maps_of == MapsOf::observed;
    const std::string frame =
        maps_of == MapsOf::observed ? "The last observed frame itself"
        : held
            ? "The last observed frame itself, held still"
            : "The forecast frame itself: the last observed frame, moved on by " +
                  (forecast.forecaster.empty() ? std::string("the forecast") : forecast.forecaster);
    const std::string light =
        "; the light, the shadows and the glints of the recording are still in it.";
    std::vector<MapOrigin> origins{
        {"albedo", photographed ? Origin::measured : Origin::modeled, frame + light},
        {"normal", Origin::modeled,
         "Slopes of the height map: dark and light texture read as low and high. One camera and "
         "one light cannot tell paint from relief, so the direction is plausible and the depth is "
         "a choice."}};
    if (photographed && observed_is_clean) {
        // Nothing has moved from the clean state: no coverage, so no color enters these maps.
        origins.push_back({"roughness", Origin::modeled,
                           "The value of polished metal, which was set by eye, with a little of "
                           "the picture's fine texture: the observed state counts as clean."});
        origins.push_back({"metallic", Origin::assumed,
                           "Metal everywhere: the observed state counts as clean, whatever "
                           "patina it already has."});
        origins.push_back({"height", Origin::modeled,
                           "Smoothed brightness, on a scale from 0 to 1 without units. No depth "
                           "was measured."});
        return origins;
    }
    origins.push_back({"roughness", Origin::modeled,
                       "Between a polished and a fully patinated value, by how far the color has "
                       "moved from " +
                           clean +
                           ". That oxide is rougher than polished metal is physics; the two values "
                           "and the curve between them were set by eye."});
    origins.push_back({"metallic", Origin::modeled,
                       "From metal to oxide by the same change of color. That the clean surface "
                       "conducts and the patina does not is a fact of the materials; that " +
                           clean + " counts as clean is an assumption."});
    origins.push_back({"height", Origin::modeled,
                       std::string("Smoothed brightness, raised where patina is ") +
                           (photographed ? "seen" : "forecast") +
                           ", on a scale from 0 to 1 without units. No depth was measured."});
    return origins;
}

}  // namespace verdigris
