// SPDX-License-Identifier: MIT
// Where `render` takes its material from.
#pragma once

#include <filesystem>
#include <memory>

#include "verdigris/forecast/forecast_io.h"
#include "verdigris/material/material.h"
#include "verdigris/render/surface_maps.h"

namespace verdigris::cli {

/// A result of `verdigris age`, which has every age, or a folder of maps, which has one.
class RenderSource {
  public:
    /// Of a result the specimen alone is taken: the largest upright rectangle that holds nothing
    /// else; or, if `whole`, the picture with its backdrop.
    /// Throws Error{bad_input}: neither, or a damaged one.
    RenderSource(const std::filesystem::path& input, bool whole);

    bool ages() const { return forecast_ != nullptr; }
    /// The last that the result was made for; 0 for a folder of maps.
    double last_horizon() const;
    /// Of the picture: width over height.
    double aspect() const;
    /// The maps of one age; `horizon` is not looked at where there is one only.
    SurfaceMaps maps(double horizon) const;

  private:
    std::unique_ptr<SavedForecast> forecast_;
    MaterialRecipe recipe_;
    Material maps_;  // of a folder
    Rect window_;
    double aspect_ = 1;
};

}  // namespace verdigris::cli
