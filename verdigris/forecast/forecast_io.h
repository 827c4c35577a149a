// SPDX-License-Identifier: MIT
// A Forecast on disk: forecast.json, base.npy, rate.npy (and curvature.npy; H, W, 3 float32, or
// stack.npy: T, H, W, 3), spread.npy (H, W, 3 float32) where the forecast states its spread, the
// context as context.npy (n, H, W, 3 float32) with specimen.png and clipped.png, and one 16-bit PNG
// per asked horizon (forecast_u010.png).
#pragma once

#include <filesystem>
#include <vector>

#include "verdigris/forecast/forecast.h"

namespace verdigris {

struct SavedForecast {
    Forecast forecast;
    Context context;
    std::vector<double> horizons;
    std::string source_name, source_sha256;
};

/// forecast.json goes last. Throws Error{failed}.
void write_forecast(const SavedForecast& saved, const std::filesystem::path& folder);
/// Throws Error{bad_input} naming the file.
SavedForecast read_forecast(const std::filesystem::path& folder);

/// "u005", "u010", "u007_5": how a horizon is written in file names; sorts, and never looks like a
/// UDIM tile number.
std::string horizon_label(double horizon);

}  // namespace verdigris
