// SPDX-License-Identifier: MIT
// A SampleLayout in observation.json.
#pragma once

#include <nlohmann/json.hpp>

#include "verdigris/observe/sample_layout.h"

namespace verdigris {

nlohmann::ordered_json json_of(const SampleLayout& layout);
/// Throws nlohmann::json::exception where something is missing or has another type, and
/// Error{bad_input} where the numbers make no sense.
SampleLayout layout_from(const nlohmann::ordered_json& json);

}  // namespace verdigris
