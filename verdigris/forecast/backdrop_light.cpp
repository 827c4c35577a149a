// SPDX-License-Identifier: MIT
#include "verdigris/forecast/backdrop_light.h"

#include <algorithm>
#include <cmath>

#include "verdigris/color/convert.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr std::int64_t kFewestPixels = 200;  // chosen: a median of fewer is noise
constexpr std::int64_t kMostPixels = 20000;  // chosen: more say little more
constexpr float kDarkest = 0.002f;           // linear; chosen: darker ratios are noise
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

}  // namespace

std::vector<std::array<double, 3>> backdrop_light(const Context& context) {
    std::vector<std::array<double, 3>> light(context.frames.size(), {1, 1, 1});
    if (context.specimen.empty() && context.backdrop.empty()) return light;
    const auto pixels = sample_inside(backdrop(context), kMostPixels);
    if (std::int64_t(pixels.size()) < kFewestPixels) return light;
    const auto last = context.frames.back().pixels();
    parallel_for(int(context.frames.size()) - 1, [&](int i) {
        const auto frame = context.frames[std::size_t(i)].pixels();
        for (int k = 0; k < 3; ++k) {
            std::vector<float> ratios;
            for (const std::size_t at : pixels) {
                const float before = linear_from_srgb(channel(frame[at], k));
                if (before > kDarkest)
                    ratios.push_back(linear_from_srgb(channel(last[at], k)) / before);
            }
            if (std::int64_t(ratios.size()) < kFewestPixels) continue;
            const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
            std::nth_element(ratios.begin(), middle, ratios.end());
            if (*middle > 0) light[std::size_t(i)][std::size_t(k)] = double(*middle);
        }
    });
    return light;
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
