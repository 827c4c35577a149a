// SPDX-License-Identifier: MIT
#include "verdigris/render/tone_map.h"

#include <algorithm>
#include <cmath>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/sobol.h"
#include "verdigris/render/vector.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 16;

// [PbrNeutral, GLSL reference]
constexpr float kStart = 0.8f - 0.04f, kDesaturation = 0.15f;

}  // namespace

LinearF pbr_neutral(LinearF c) {
    c = {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)};
    // A dielectric's own reflection, which the formula takes off so that its base color remains.
    const float least = std::min({c.r, c.g, c.b});
    const float offset = least < 0.08f ? least - 6.25f * least * least : 0.04f;
    c = c - gray(offset);
    const float peak = std::max({c.r, c.g, c.b});
    if (peak < kStart) return c;
    const float d = 1 - kStart, rolled = 1 - d * d / (peak + d - kStart);
    c = c * (rolled / peak);
    const float white = 1 - 1 / (kDesaturation * (peak - rolled) + 1);
    return mix(c, gray(rolled), white);
}

Image<SrgbU8> developed(const Image<LinearF>& light, double exposure) {
    const float gain = float(std::exp2(exposure));
    auto out = Image<SrgbU8>::for_overwrite(light.width(), light.height());
    parallel_rows(light.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < light.width(); ++x) {
                const SrgbF c = srgb_from_linear(pbr_neutral(light(x, y) * gain));
                // One number for all channels: rounding must not tint.
                const std::uint32_t bits = seed_of(std::uint32_t(x), std::uint32_t(y));
                const float shift = (float(bits >> 8) * 0x1.0p-24f - 0.5f) / 255;
                const auto shifted = [shift](float v) { return v > 0 && v < 1 ? v + shift : v; };
                out(x, y) = u8_from_srgb({shifted(c.r), shifted(c.g), shifted(c.b)});
            }
        }
    });
    return out;
}

}  // namespace verdigris
