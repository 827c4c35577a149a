// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/material/change.h"
#include "verdigris/material/luma_fill.h"
#include "verdigris/material/options_check.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr std::size_t kBlock = 96;  // chosen: floats sorted side by side; n of them stay in L1

/// Median over the frames of every float of a row; the mean of the middle two for an even count.
/// An odd-even transposition sort: n rounds of compare and exchange on whole blocks, no branch.
void median_row(const std::vector<const float*>& rows, std::size_t count, float* out) {
    const std::size_t n = rows.size();
    std::vector<float> sorted(n * kBlock);
    const auto lane = [&](std::size_t i) { return sorted.data() + i * kBlock; };
    for (std::size_t at = 0; at < count; at += kBlock) {
        const std::size_t size = std::min(kBlock, count - at);
        for (std::size_t i = 0; i < n; ++i) std::copy_n(rows[i] + at, size, lane(i));
        for (std::size_t round = 0; round < n; ++round) {
            for (std::size_t i = round % 2; i + 1 < n; i += 2) {
                float* a = lane(i);
                float* b = lane(i + 1);
                for (std::size_t k = 0; k < kBlock; ++k) {
                    const float low = std::min(a[k], b[k]), high = std::max(a[k], b[k]);
                    a[k] = low;
                    b[k] = high;
                }
            }
        }
        const float* low = lane((n - 1) / 2);
        const float* high = lane(n / 2);
        for (std::size_t k = 0; k < size; ++k) out[at + k] = 0.5f * (low[k] + high[k]);
    }
}

Image<SrgbF> temporal_median(const std::vector<Image<SrgbF>>& frames) {
    const int width = frames[0].width(), height = frames[0].height();
    Image<SrgbF> median = Image<SrgbF>::for_overwrite(width, height);
    parallel_rows(height, std::max(1, 8192 / width), [&](RowRun run) {
        std::vector<const float*> rows(frames.size());
        for (int y = run.begin; y < run.end; ++y) {
            for (std::size_t i = 0; i < frames.size(); ++i) {
                rows[i] = reinterpret_cast<const float*>(frames[i].row(y));
            }
            median_row(rows, std::size_t(width) * 3, reinterpret_cast<float*>(median.row(y)));
        }
    });
    return median;
}

Mask active_mask(const Context& context) {
    const Image<SrgbF>& frame = context.frames[0];
    Mask active(frame.width(), frame.height());
    for (std::size_t i = 0; i < active.pixel_count(); ++i) {
        const bool specimen = context.specimen.empty() || context.specimen.pixels()[i] != 0;
        const bool clipped = !context.clipped.empty() && context.clipped.pixels()[i] != 0;
        active.pixels()[i] = !specimen ? std::uint8_t(0) : clipped ? kUnderGlint : kInside;
    }
    return active;
}

/// Pixels at or next to saturation.
Mask saturated(const Image<SrgbF>& image) {
    constexpr float kSaturated = 0.98f;  // as observe/ masks clipped pixels
    constexpr int kReach = 2;            // chosen: lens blur carries a glint about this far
    Mask mask(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const SrgbF& c = image(x, y);
            if (std::max({c.r, c.g, c.b}) < kSaturated) continue;
            for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, image.height() - 1);
                 ++v) {
                const int from = std::max(x - kReach, 0);
                const int to = std::min(x + kReach, image.width() - 1);
                std::fill(mask.row(v) + from, mask.row(v) + to + 1, kInside);
            }
        }
    }
    return mask;
}

/// s of Eq. (2): the percentile of the changes above tau, less tau.
double normalizer(const Image<float>& change, const Mask& active, double tau, double percentile) {
    std::vector<float> above;
    for (std::size_t i = 0; i < change.pixel_count(); ++i) {
        const float c = change.pixels()[i];
        if (active.pixels()[i] == kInside && double(c) > tau) above.push_back(c);
    }
    if (above.empty()) return 1;
    const auto rank = std::ptrdiff_t(std::lround(percentile * double(above.size() - 1)));
    std::nth_element(above.begin(), above.begin() + rank, above.end());
    // chosen: never less than tau. A forecast that barely leaves the dead-zone would otherwise be
    // stretched to full patina, and its noise with it; so would tau = 0 and a change of 1e-7.
    return std::max({double(above[std::size_t(rank)]) - tau, tau, 1e-6});
}

void check_inputs(const Context& context, const Forecast& forecast) {
    const Image<SrgbF>& base =
        forecast.is_trajectory() ? forecast.trajectory.base : forecast.stack.base;
    if (context.frames.empty() || context.frames[0].empty()) {
        throw Error(ErrorCode::usage, "a material needs at least one observed frame");
    }
    bool same = true;
    for (const Image<SrgbF>& frame : context.frames) same = same && frame.same_size(base);
    for (const Mask* mask : {&context.specimen, &context.clipped}) {
        same = same && (mask->empty() || mask->same_size(base));
    }
    if (!same) {
        throw Error(ErrorCode::usage,
                    "the observed frames, the masks and the forecast differ in size");
    }
}

/// Counted from a clean state, what is clipped now is covered as the specimen around it: a bright
/// salt in one saturated channel is no polished metal. The coverage is the recipe's own equation of
/// |X - C|, so C is moved along X - C until the change is that around it; the drift is 0 there.
void cover_clipped(MaterialRecipe& recipe, const Context& context, const Image<SrgbF>& now) {
    if (context.clipped.empty()) return;
    const Image<float> change = change_map(now, recipe.canvas);
    Image<float> filled = change.clone();
    if (!fill_values(filled, context.specimen, context.clipped)) return;
    for (std::size_t i = 0; i < filled.pixel_count(); ++i) {
        if (recipe.active.pixels()[i] != kUnderGlint) continue;
        const float is = change.pixels()[i], wanted = filled.pixels()[i];
        const SrgbF x = now.pixels()[i];
        SrgbF& c = recipe.canvas.pixels()[i];
        if (is > 1e-4f) {
            const float s = wanted / is;
            c = {x.r - s * (x.r - c.r), x.g - s * (x.g - c.g), x.b - s * (x.b - c.b)};
        } else {
            c = {x.r - wanted, x.g - wanted, x.b - wanted};
        }
        recipe.active.pixels()[i] = kInside;
    }
}

}  // namespace

bool has_left(const Image<SrgbF>& start, const Context& context) {
    constexpr double kVisible = 0.05;
    const Image<float> change = change_map(temporal_median(context.frames), start);
    const Mask active = active_mask(context);
    double sum = 0;
    std::int64_t count = 0;
    for (std::size_t i = 0; i < change.pixel_count(); ++i) {
        if (active.pixels()[i] != kInside) continue;
        sum += double(change.pixels()[i]);
        ++count;
    }
    return count > 0 && sum / double(count) > std::max(kVisible, 2 * context.tau);
}

MaterialRecipe prepare_material(const Context& context, const Forecast& forecast,
                                const MaterialOptions& options, const Image<SrgbF>* clean_state) {
    check_options(options);
    check_inputs(context, forecast);
    MaterialRecipe recipe;
    recipe.options = options;
    recipe.tau = context.tau;
    recipe.canvas = temporal_median(context.frames);
    recipe.active = active_mask(context);
    recipe.luma_fill = fill_luma(recipe.canvas, context.specimen, context.clipped);

    const float tau = float(context.tau);
    if (clean_state != nullptr) {
        if (!clean_state->same_size(recipe.canvas)) {
            throw Error(ErrorCode::usage, "the clean state and the observed frames differ in size");
        }
        recipe.observed_is_clean = false;
        recipe.canvas = clean_state->clone();
        // A glint in the clean state says nothing about the metal under it: the metal around does.
        fill_colors(recipe.canvas, context.specimen, saturated(recipe.canvas));
        recipe.dead_zone = Image<float>(recipe.canvas.width(), recipe.canvas.height());
        cover_clipped(recipe, context, forecast.at(0));
    } else {
        recipe.dead_zone = change_map(forecast.at(0), recipe.canvas);
    }
    for (float& d : recipe.dead_zone.pixels()) d = std::max(d, tau);

    const double asked =
        options.reference_horizon > 0 ? options.reference_horizon : 2.0 * context.length();
    recipe.reference_horizon =
        forecast.is_trajectory() ? asked : std::min(asked, forecast.stack.horizons.back());
    recipe.normalizer =
        normalizer(change_map(forecast.at(recipe.reference_horizon), recipe.canvas),
                   active_mask(context), context.tau, options.normalizer_percentile);
    return recipe;
}

}  // namespace verdigris
