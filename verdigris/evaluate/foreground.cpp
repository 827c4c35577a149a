// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/foreground.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "verdigris/observe/noise.h"

namespace verdigris {
namespace {

/// Puts n values of each column in order by exchanging neighbors: n passes over rows of floats,
/// which the compiler vectorizes.
void sort_columns(float* rows, std::size_t n, std::size_t width) {
    for (std::size_t pass = 0; pass < n; ++pass) {
        for (std::size_t i = pass % 2; i + 1 < n; i += 2) {
            float* a = rows + i * width;
            float* b = a + width;
            for (std::size_t x = 0; x < width; ++x) {
                const float low = std::min(a[x], b[x]), high = std::max(a[x], b[x]);
                a[x] = low;
                b[x] = high;
            }
        }
    }
}

}  // namespace

double foreground_threshold(const EvaluationProtocol& protocol, double sigma) {
    return protocol.tau.value_or(std::max(noise_from(sigma, std::nullopt).tau, protocol.tau_floor));
}

PixelWeights weights_of(const Mask& mask, int width, int height) {
    PixelWeights out;
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    out.weight.assign(pixels, 1.0f);
    out.count = std::int64_t(pixels);
    if (mask.empty()) return out;
    out.count = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const bool inside = mask.pixels()[i] != 0;
        out.weight[i] = inside ? 1.0f : 0.0f;
        out.count += inside;
    }
    return out;
}

void canvas_of(std::span<const Image<SrgbF>> context, Image<SrgbF>& canvas,
               std::vector<float>& scratch) {
    const std::size_t n = context.size(), width = 3 * std::size_t(context[0].width());
    if (!canvas.same_size(context[0])) {
        canvas = Image<SrgbF>::for_overwrite(context[0].width(), context[0].height());
    }
    scratch.resize(n * width);
    for (int y = 0; y < canvas.height(); ++y) {
        for (std::size_t i = 0; i < n; ++i) {
            std::copy_n(&context[i].row(y)->r, width, scratch.data() + i * width);
        }
        sort_columns(scratch.data(), n, width);
        const float* low = scratch.data() + (n - 1) / 2 * width;
        const float* high = scratch.data() + n / 2 * width;
        float* out = &canvas.row(y)->r;
        for (std::size_t x = 0; x < width; ++x) out[x] = 0.5f * (low[x] + high[x]);
    }
}

void foreground_of(std::span<const Image<SrgbF>* const> truths, const Image<SrgbF>& canvas,
                   double tau, MaskRule rule, const PixelWeights& area,
                   std::vector<PixelWeights>& foreground) {
    const bool together = rule == MaskRule::union_of_horizons;
    foreground.resize(together ? 1 : truths.size());
    const std::size_t pixels = canvas.pixel_count();
    const float threshold = float(3 * tau);
    const auto base = canvas.pixels();
    for (PixelWeights& f : foreground) f.weight.assign(pixels, 0.0f);
    for (std::size_t k = 0; k < truths.size(); ++k) {
        float* weight = foreground[together ? 0 : k].weight.data();
        const auto truth = truths[k]->pixels();
        for (std::size_t i = 0; i < pixels; ++i) {
            const SrgbF a = truth[i], c = base[i];
            const float change = std::fabs(a.r - c.r) + std::fabs(a.g - c.g) + std::fabs(a.b - c.b);
            weight[i] = std::max(weight[i], change > threshold ? area.weight[i] : 0.0f);
        }
    }
    for (PixelWeights& f : foreground) {
        f.count = std::count(f.weight.begin(), f.weight.end(), 1.0f);
    }
}

}  // namespace verdigris
