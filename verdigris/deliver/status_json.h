// SPDX-License-Identifier: MIT
// Guards and origins as JSON: the viewer's document and the manifest say them alike.
// Not a public header of the room: it names a third-party type.
#pragma once

#include <nlohmann/json.hpp>

#include "verdigris/forecast/forecast.h"
#include "verdigris/material/material.h"
#include "verdigris/status.h"

namespace verdigris {

/// [{"id", "severity", "sentence"}]
nlohmann::ordered_json guards_json(const Statuses& guards);
/// [{"map", "origin", "sentence"}]
nlohmann::ordered_json origins_json(const Forecast& forecast, const MaterialRecipe& recipe);

}  // namespace verdigris
