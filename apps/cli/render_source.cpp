// SPDX-License-Identifier: MIT
#include "render_source.h"

#include <algorithm>
#include <system_error>

#include "stages.h"
#include "verdigris/error.h"
#include "verdigris/material/material_io.h"
#include "verdigris/render/largest_rectangle.h"
#include "verdigris/render/material_folder.h"

namespace verdigris::cli {
namespace fs = std::filesystem;

RenderSource::RenderSource(const fs::path& input, bool whole) {
    std::error_code error;
    if (!fs::is_directory(input, error)) {
        throw Error(ErrorCode::bad_input,
                    "is neither a result of `verdigris age` nor a folder of maps", input.string());
    }
    if (fs::is_directory(input / kForecastFolder, error)) {
        require_stage(input, kMaterialFolder, "materialize");
        forecast_ = std::make_unique<SavedForecast>(read_forecast(input / kForecastFolder));
        recipe_ = read_recipe(input / kMaterialFolder);
        const Image<SrgbF> now = forecast_->forecast.at(0);
        if (!recipe_.canvas.same_size(now)) {
            throw Error(ErrorCode::bad_input,
                        "the stages in it do not belong together; run `verdigris forecast` and "
                        "`verdigris materialize` again",
                        input.string());
        }
        forecast_->context.frames.clear();  // half of the memory, and nothing here needs it
        window_ = whole ? Rect{0, 0, now.width(), now.height()}
                        : largest_rectangle(recipe_.active, now.width(), now.height());
        aspect_ = double(window_.width) / window_.height;
        return;
    }
    if (!is_material_folder(input)) {
        throw Error(ErrorCode::bad_input,
                    "is neither a result of `verdigris age` nor a folder of maps (there is no "
                    "picture named ..._Color)",
                    input.string());
    }
    maps_ = read_material_folder(input);
    window_ = {0, 0, maps_.albedo.width(), maps_.albedo.height()};
    aspect_ = double(window_.width) / window_.height;
}

double RenderSource::last_horizon() const {
    if (!forecast_ || forecast_->horizons.empty()) return 0;
    return *std::max_element(forecast_->horizons.begin(), forecast_->horizons.end());
}

double RenderSource::aspect() const {
    return aspect_;
}

SurfaceMaps RenderSource::maps(double horizon) const {
    if (!forecast_) return SurfaceMaps(maps_);
    Material m;
    materialize(recipe_, forecast_->forecast, horizon, m);
    return SurfaceMaps(m, window_);
}

}  // namespace verdigris::cli
