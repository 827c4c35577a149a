// SPDX-License-Identifier: MIT
#include "verdigris/deliver/status_json.h"

#include "verdigris/deliver/uncertainty.h"
#include "verdigris/material/material.h"

namespace verdigris {
using Json = nlohmann::ordered_json;

Json guards_json(const Statuses& guards) {
    Json list = Json::array();
    for (const Status& guard : guards) {
        list.push_back({{"id", guard.id},
                        {"severity", to_string(guard.severity)},
                        {"sentence", guard.sentence}});
    }
    return list;
}

Json origins_json(const Forecast& forecast, const MaterialRecipe& recipe) {
    Json list = Json::array();
    for (const MapOrigin& origin : map_origins(forecast, recipe.observed_is_clean)) {
        list.push_back({{"map", origin.map},
                        {"origin", to_string(origin.origin)},
                        {"sentence", origin.sentence}});
    }
    return list;
}

Json uncertainty_json(const Delivery& delivery) {
    Json list;  // null
    for (const Uncertainty& u : uncertainty_of(delivery)) {
        list.push_back({{"horizon", u.horizon},
                        {"mean_80", u.mean80},
                        {"mean_95", u.mean95},
                        {"pixel_80", u.pixel80},
                        {"pixel_95", u.pixel95}});
    }
    return list;
}

}  // namespace verdigris
