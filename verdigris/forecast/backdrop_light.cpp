// SPDX-License-Identifier: MIT
#include "verdigris/forecast/backdrop_light.h"

#include <algorithm>
#include <cmath>

#include "verdigris/color/convert.h"
#include "verdigris/forecast/context_noise.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/increments.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr std::int64_t kFewestPixels = 200;  // chosen: a median of fewer is noise
constexpr std::int64_t kMostPixels = 20000;  // chosen: more say little more
constexpr float kDarkest = 0.002f;           // linear; chosen: darker ratios are noise
constexpr std::int64_t kGlance = 2000;
constexpr double kGray = 1.0 / 7;  // chosen
constexpr int kTable = 1024;

/// What is said to be backdrop, or else what is not specimen.
Mask backdrop(const Context& context) {
    Mask mask = fit_mask(context, FitPixels::all);
    const bool said = !context.backdrop.empty();
    const auto known = said ? context.backdrop.pixels() : context.specimen.pixels();
    const auto out = mask.pixels();
    for (std::size_t i = 0; i < out.size(); ++i)
        if ((known[i] != 0) != said) out[i] = 0;
    return mask;
}

float channel(const SrgbF& c, int k) {
    return k == 0 ? c.r : k == 1 ? c.g : c.b;
}

LightGains median_light(const Context& context, const std::vector<std::size_t>& pixels) {
    LightGains light(context.frames.size(), {1, 1, 1});
    const auto linear = [&](const Image<SrgbF>& frame, int k, std::vector<float>& out) {
        out.clear();
        for (const std::size_t at : pixels)
            out.push_back(linear_from_srgb(channel(frame.pixels()[at], k)));
    };
    std::array<std::vector<float>, 3> last;
    parallel_for(3, [&](int k) { linear(context.frames.back(), k, last[std::size_t(k)]); });
    parallel_for(3 * (int(context.frames.size()) - 1), [&](int job) {
        const auto i = std::size_t(job / 3), k = std::size_t(job % 3);
        std::vector<float> before, ratios;
        linear(context.frames[i], int(k), before);
        for (std::size_t at = 0; at < before.size(); ++at)
            if (before[at] > kDarkest) ratios.push_back(last[k][at] / before[at]);
        if (std::int64_t(ratios.size()) < kFewestPixels) return;
        const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
        std::nth_element(ratios.begin(), middle, ratios.end());
        if (*middle > 0) light[i][k] = double(*middle);
    });
    return light;
}

/// One gain for all channels, as light and exposure have it and copper has not: channels differ by
/// at most this share of the largest change.
bool is_gray(const LightGains& light, double share) {
    double largest = 0, apart = 0;
    for (const auto& gain : light) {
        const double r = std::log(gain[0]), g = std::log(gain[1]), b = std::log(gain[2]);
        largest = std::max(largest, std::abs(r + g + b) / 3);
        apart = std::max(apart, std::max({r, g, b}) - std::min({r, g, b}));
    }
    return largest > 0 && apart <= share * largest;
}

/// Do frames under this light differ by their noise alone, and as they are by more?
bool explains_all(const Context& context, const LightGains& light, const Mask& inside) {
    const double sigma =
        context.sigma > 0 ? context.sigma : context_noise(context.frames, inside, 1e-3);
    const double noise = 2 * sigma * sigma;
    double as_it_is = 0, under_it = 0;
    for (std::size_t i = 0; i + 1 < context.frames.size(); ++i) {
        const auto& last = context.frames.back();
        as_it_is = std::max(as_it_is, mean_square_difference(context.frames[i], last, inside));
        under_it = std::max(
            under_it, mean_square_difference(relit(context.frames[i], light[i]), last, inside));
    }
    // chosen: half as much again, for noise that is not known better.
    return under_it <= 1.5 * noise && as_it_is > 1.5 * noise;
}

}  // namespace

bool shows_light(const Context& context) {
    if (context.specimen.empty() && context.backdrop.empty()) return false;
    return std::int64_t(sample_inside(backdrop(context), kMostPixels).size()) >= kFewestPixels;
}

LightGains backdrop_light(const Context& context) {
    const LightGains none(context.frames.size(), {1, 1, 1});
    if (!context.specimen.empty() || !context.backdrop.empty()) {
        const auto pixels = sample_inside(backdrop(context), kMostPixels);
        if (std::int64_t(pixels.size()) >= kFewestPixels) return median_light(context, pixels);
    }
    const Mask all = fit_mask(context, FitPixels::all);
    const auto pixels = sample_inside(all, kMostPixels);
    if (std::int64_t(pixels.size()) < kFewestPixels) return none;
    // Hardly any picture is like that, and a glance shows it.
    if (!is_gray(median_light(context, sample_inside(all, kGlance)), 2 * kGray)) return none;
    LightGains light = median_light(context, pixels);
    return is_gray(light, kGray) && explains_all(context, light, all) ? light : none;
}

Image<SrgbF> relit(const Image<SrgbF>& frame, const std::array<double, 3>& gain) {
    // By a table: the curve is smooth, and two powers per channel would cost more than all else.
    if (gain == std::array<double, 3>{1, 1, 1}) return frame.clone();
    std::array<std::vector<float>, 3> factor;
    for (std::size_t k = 0; k < 3; ++k) {
        for (int i = 0; i <= kTable; ++i) {
            const float v = std::max(float(i) / float(kTable), 1e-4f);
            factor[k].push_back(srgb_from_linear(linear_from_srgb(v) * float(gain[k])) / v);
        }
    }
    const auto changed = [&](float v, std::size_t k) {
        const float at = std::clamp(v, 0.0f, 1.0f) * float(kTable);
        const int i = std::min(int(at), kTable - 1);
        const float a = factor[k][std::size_t(i)], b = factor[k][std::size_t(i) + 1];
        return v * (a + (at - float(i)) * (b - a));
    };
    Image<SrgbF> out = Image<SrgbF>::for_overwrite(frame.width(), frame.height());
    parallel_rows(frame.height(), 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const SrgbF* from = frame.row(y);
            SrgbF* to = out.row(y);
            for (int x = 0; x < frame.width(); ++x)
                to[x] = {changed(from[x].r, 0), changed(from[x].g, 1), changed(from[x].b, 2)};
        }
    });
    return out;
}

}  // namespace verdigris
