// SPDX-License-Identifier: MIT
// The library's results as JSON: the stable --json output and the manifest's facts.
#pragma once

#include <nlohmann/json.hpp>

#include "arguments.h"
#include "verdigris/forecast/choose.h"
#include "verdigris/forecast/forecast.h"
#include "verdigris/observe/inspect.h"
#include "verdigris/observe/observe.h"
#include "verdigris/recording/recording.h"

namespace verdigris::cli {

using Json = nlohmann::ordered_json;

Json json_of(const Status& status);
Json json_of(const Statuses& statuses);
Json json_of(Rect rect);
Json json_of(const RecordingInfo& info);
Json json_of(const Inspection& inspection);
/// Input, axis, crop, noise and what was lost; no pixels.
Json json_of(const Observation& observation);
/// Forecaster, explanation, guards; no pixels.
Json json_of(const Forecast& forecast);
Json json_of(const ObserveArguments& arguments);
Json json_of(const ForecastArguments& arguments);
Json json_of(const MaterialArguments& arguments);

std::string to_string(TimeSource source);

}  // namespace verdigris::cli
