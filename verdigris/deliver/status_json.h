// SPDX-License-Identifier: MIT
// Guards, origins and uncertainty as JSON: the viewer's document and the manifest say them alike.
// Not a public header of the room: it names a third-party type.
#pragma once

#include <nlohmann/json.hpp>

#include "verdigris/deliver/delivery.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/material/material.h"
#include "verdigris/status.h"

namespace verdigris {

/// [{"id", "severity", "sentence"}]
nlohmann::ordered_json guards_json(const Statuses& guards);
/// [{"map", "origin", "sentence"}]
nlohmann::ordered_json origins_json(const Forecast& forecast, const MaterialRecipe& recipe);

/// [{"horizon", "mean_80", "mean_95", "pixel_80", "pixel_95"}], or null where none is stated.
nlohmann::ordered_json uncertainty_json(const Delivery& delivery);

}  // namespace verdigris
