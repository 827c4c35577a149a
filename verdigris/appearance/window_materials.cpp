// SPDX-License-Identifier: MIT
#include "verdigris/appearance/window_materials.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace verdigris {
namespace {

Context material_context(const ScoredWindow& window) {
    Context context;
    for (const Image<SrgbF>& f : window.context.frames) context.frames.push_back(f.clone());
    context.specimen = window.observation.specimen.clone();
    context.clipped = window.context.clipped.clone();
    context.sigma = window.context.sigma;
    context.tau = window.context.tau;
    return context;
}

std::array<double, 3> channels(SrgbF c) {
    return {double(c.r), double(c.g), double(c.b)};
}

}  // namespace

std::string_view to_string(CoverageScale scale) {
    return scale == CoverageScale::truth ? "truth" : "frame";
}

WindowMaterials::WindowMaterials(const ScoredWindow& window, int furthest, CoverageScale scale)
    : context_(material_context(window)), scale_(scale) {
    const int reference = std::min(2 * context_.length(), furthest);
    recipe_ = recipe_of(window.truth(reference), reference);
}

MaterialRecipe WindowMaterials::recipe_of(const Image<SrgbF>& frame, double horizon) const {
    Forecast as_forecast;
    as_forecast.stack.base = context_.frames.back().clone();
    as_forecast.stack.horizons = {horizon};
    as_forecast.stack.frames.push_back(frame.clone());
    MaterialOptions options;
    options.reference_horizon = horizon;
    return prepare_material(context_, as_forecast, options);
}

Material WindowMaterials::material(const Image<SrgbF>& frame, double horizon) const {
    Material out;
    if (scale_ == CoverageScale::truth) {
        materialize(recipe_, frame.view(), out);
    } else {
        materialize(recipe_of(frame, horizon), frame.view(), out);
    }
    return out;
}

FrameMotion frame_motion(const Image<SrgbF>& frame, const Image<SrgbF>& truth,
                         const Image<SrgbF>& last, Rect where) {
    FrameMotion m;
    double forecast_squares = 0, truth_squares = 0, products = 0;
    for (int y = where.y; y < where.y + where.height; ++y) {
        for (int x = where.x; x < where.x + where.width; ++x) {
            const auto f = channels(frame(x, y)), t = channels(truth(x, y)),
                       l = channels(last(x, y));
            int outside = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double moved = f[c] - l[c], should = t[c] - l[c];
                m.error += (f[c] - t[c]) * (f[c] - t[c]);
                m.moved += std::abs(moved);
                forecast_squares += moved * moved;
                truth_squares += should * should;
                products += moved * should;
                outside += !(f[c] >= 0 && f[c] <= 1);
            }
            m.outside_channels += outside;
            m.outside_pixels += outside > 0;
        }
    }
    const double pixels = double(where.width) * where.height;
    m.error /= 3 * pixels;
    m.moved /= 3 * pixels;
    m.outside_channels /= 3 * pixels;
    m.outside_pixels /= pixels;
    m.agreement = products / std::sqrt(forecast_squares * truth_squares);  // 0 / 0 is NaN
    return m;
}

Image<SrgbF> unclamped(const Forecast& forecast, double horizon) {
    if (!forecast.is_trajectory() || !forecast.trajectory.clamp) return forecast.at(horizon);
    const Trajectory& t = forecast.trajectory;
    Trajectory free;
    free.base = t.base.clone();
    free.rate = t.rate.clone();
    free.curvature = t.curvature.clone();
    free.law = t.law;
    free.clamp = false;
    Image<SrgbF> out;
    evaluate_trajectory(free, horizon, out);
    return out;
}

}  // namespace verdigris
