// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verdigris/error.h"
#include "verdigris/material/gaussian.h"
#include "verdigris/material/options_check.h"
#include "verdigris/material/row_rings.h"
#include "verdigris/material/tile.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: rows of a strip. 9 rows of color are computed again at either end, so strips are tall
// where there are rows to spare (7 % at 256) and short enough for every core to get one.
int strip_rows(int height) {
    return std::clamp(height / 8, 32, 256);
}

template <class P>
void fit(Image<P>& image, int width, int height) {
    if (!image.same_size(width, height)) image = Image<P>::for_overwrite(width, height);
}

void run(TileJob& job, const MaterialRecipe& recipe, int width, int height, Material& out) {
    check_options(recipe.options);
    const bool fits = recipe.canvas.same_size(width, height) &&
                      recipe.dead_zone.same_size(width, height) &&
                      (recipe.active.empty() || recipe.active.same_size(width, height)) &&
                      (recipe.luma_fill.empty() || recipe.luma_fill.same_size(width, height));
    if (!fits) throw Error(ErrorCode::usage, "the recipe was made for another frame size");
    if (!(recipe.normalizer > 0)) {
        throw Error(ErrorCode::usage, "the normalizer of a recipe must be positive");
    }
    fit(out.albedo, width, height);
    fit(out.normal, width, height);
    fit(out.roughness, width, height);
    fit(out.metallic, width, height);
    fit(out.height, width, height);
    fit(out.coverage, width, height);
    if (width == 0 || height == 0) return;
    job.recipe = &recipe;
    job.height_taps = gaussian_taps(recipe.options.height_sigma);
    job.micro_taps = gaussian_taps(recipe.options.micro_sigma);
    job.width = width;
    job.height = height;
    job.out = &out;
    parallel_rows(height, strip_rows(height), [&](RowRun rows) {
        for (int x = 0; x < width; x += kTileColumns) {
            materialize_tile(
                job, {x, rows.begin, std::min(kTileColumns, width - x), rows.end - rows.begin});
        }
    });
}

}  // namespace

void check_options(const MaterialOptions& o) {
    const auto positive = [](double v, const char* name) {
        if (!(v > 0) || !std::isfinite(v)) {
            throw Error(ErrorCode::usage,
                        fmt::format("the material option {} must be positive", name));
        }
    };
    const auto unit = [](double v, const char* name) {
        if (!(v >= 0 && v <= 1)) {
            throw Error(ErrorCode::usage,
                        fmt::format("the material option {} must lie in [0, 1]", name));
        }
    };
    const auto blur = [](double v, const char* name) {
        if (!(v >= 0) || std::ceil(3 * v) > kMaxRadius) {
            throw Error(ErrorCode::usage, fmt::format("the material option {} must lie in [0, {}]",
                                                      name, kMaxRadius / 3));
        }
    };
    positive(o.coverage_exponent, "coverage_exponent");
    positive(o.roughness_gamma, "roughness_gamma");
    positive(o.metallic_gamma, "metallic_gamma");
    positive(o.micro_range, "micro_range");
    unit(o.normalizer_percentile, "normalizer_percentile");
    unit(o.roughness_clean, "roughness_clean");
    unit(o.roughness_patina, "roughness_patina");
    unit(o.micro_roughness, "micro_roughness");
    unit(o.metallic_clean, "metallic_clean");
    unit(o.metallic_patina, "metallic_patina");
    unit(o.height_patina_weight, "height_patina_weight");
    blur(o.height_sigma, "height_sigma");
    blur(o.micro_sigma, "micro_sigma");
    if (!std::isfinite(o.normal_scale) || !std::isfinite(o.normal_gain)) {
        throw Error(ErrorCode::usage,
                    "the material options normal_scale and normal_gain must be numbers");
    }
    if (!(o.reference_horizon >= 0) || !std::isfinite(o.reference_horizon)) {
        throw Error(ErrorCode::usage, "the material option reference_horizon must be 0 or more");
    }
}

void materialize(const MaterialRecipe& recipe, ImageView<const SrgbF> frame, Material& out) {
    TileJob job;
    job.frame = frame;
    run(job, recipe, frame.width(), frame.height(), out);
}

void materialize(const MaterialRecipe& recipe, const Trajectory& trajectory, double horizon,
                 Material& out) {
    check_trajectory(trajectory, horizon);
    TileJob job;
    job.trajectory = &trajectory;
    job.time = trajectory_time(trajectory, horizon);
    run(job, recipe, trajectory.base.width(), trajectory.base.height(), out);
}

void materialize(const MaterialRecipe& recipe, const Forecast& forecast, double horizon,
                 Material& out) {
    if (forecast.is_trajectory()) {
        materialize(recipe, forecast.trajectory, horizon, out);
    } else {
        materialize(recipe, forecast.at(horizon).view(), out);
    }
}

}  // namespace verdigris
