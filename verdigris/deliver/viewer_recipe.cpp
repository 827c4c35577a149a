// SPDX-License-Identifier: MIT
#include "verdigris/deliver/viewer_recipe.h"

#include <algorithm>
#include <cstddef>

namespace verdigris {
namespace {

// chosen: a coarse pixel is what at least half of its area is.
constexpr float kMajority = 0.5f;

/// 1 where the mask is at least `least`.
Image<float> share_of(const MaterialRecipe& recipe, int least) {
    Image<float> share(recipe.canvas.width(), recipe.canvas.height());
    const bool all = recipe.active.empty();
    for (std::size_t i = 0; i < share.pixel_count(); ++i) {
        share.pixels()[i] = all || recipe.active.pixels()[i] >= least ? 1.0f : 0.0f;
    }
    return share;
}

}  // namespace

ViewerRecipe viewer_recipe(const MaterialRecipe& recipe, PictureSize extent) {
    const Image<SrgbF>& canvas = recipe.canvas;
    const double factor = double(std::max(canvas.width(), canvas.height())) /
                          double(std::max({extent.width, extent.height, 1}));
    ViewerRecipe result;
    result.options = recipe.options;
    result.options.height_sigma /= factor;
    result.options.micro_sigma /= factor;
    result.options.normal_gain /= factor;
    result.canvas = resampled(canvas, extent);
    result.dead_zone = resampled(recipe.dead_zone, extent);
    result.active = resampled(share_of(recipe, kInside), extent);
    const Image<float> specimen = resampled(share_of(recipe, kUnderGlint), extent);
    for (std::size_t i = 0; i < specimen.pixel_count(); ++i) {
        float& v = result.active.pixels()[i];
        v = specimen.pixels()[i] < kMajority ? 0.0f : v >= kMajority ? 1.0f : 0.5f;
    }

    // Weighted: the average of fills over filled pixels is average(fill * w) / average(w).
    Image<float> weight(canvas.width(), canvas.height()), fill(canvas.width(), canvas.height());
    for (std::size_t i = 0; i < recipe.luma_fill.pixel_count(); ++i) {
        const float value = recipe.luma_fill.pixels()[i];
        weight.pixels()[i] = value >= 0 ? 1.0f : 0.0f;
        fill.pixels()[i] = std::max(value, 0.0f);
    }
    const Image<float> share = resampled(weight, extent);
    result.luma_fill = resampled(fill, extent);
    for (std::size_t i = 0; i < share.pixel_count(); ++i) {
        float& v = result.luma_fill.pixels()[i];
        v = share.pixels()[i] >= kMajority ? v / share.pixels()[i] : -1.0f;
    }
    return result;
}

}  // namespace verdigris
