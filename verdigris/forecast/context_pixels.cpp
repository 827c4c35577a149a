// SPDX-License-Identifier: MIT
#include "verdigris/forecast/context_pixels.h"

#include <algorithm>
#include <cstring>

namespace verdigris {
namespace {

Mask combine(const Context& context, bool specimen_only) {
    const Image<SrgbF>& frame = context.frames.front();
    Mask mask = Mask::for_overwrite(frame.width(), frame.height());
    const auto out = mask.pixels();
    const bool use_specimen = specimen_only && !context.specimen.empty();
    if (use_specimen) {
        const auto specimen = context.specimen.pixels();
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = specimen[i] ? kInside : 0;
    } else {
        std::fill(out.begin(), out.end(), kInside);
    }
    if (!context.clipped.empty()) {
        const auto clipped = context.clipped.pixels();
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = clipped[i] ? 0 : out[i];
    }
    return mask;
}

}  // namespace

void check_context(const Context& context) {
    if (context.frames.empty() || context.frames.front().empty()) {
        throw Error(ErrorCode::usage, "a forecast needs at least one observed frame");
    }
    const Image<SrgbF>& first = context.frames.front();
    for (const Image<SrgbF>& frame : context.frames) {
        if (!frame.same_size(first)) {
            throw Error(ErrorCode::usage, "the observed frames differ in size");
        }
    }
    for (const Mask* mask : {&context.specimen, &context.clipped}) {
        if (!mask->empty() && !mask->same_size(first)) {
            throw Error(ErrorCode::usage, "the masks and the observed frames differ in size");
        }
    }
}

Mask fit_mask(const Context& context, FitPixels pixels) {
    return combine(context, pixels == FitPixels::specimen);
}

Mask moving_mask(const Context& context) {
    return combine(context, true);
}

std::int64_t count_inside(const Mask& mask) {
    const auto pixels = mask.pixels();
    return std::count_if(pixels.begin(), pixels.end(), [](std::uint8_t v) { return v != 0; });
}

std::vector<std::size_t> sample_inside(const Mask& mask, std::int64_t limit) {
    const std::int64_t inside = count_inside(mask);
    const std::int64_t step = std::max<std::int64_t>(1, (inside + limit - 1) / limit);
    std::vector<std::size_t> indices;
    indices.reserve(std::size_t(inside / step + 1));
    const auto pixels = mask.pixels();
    std::int64_t seen = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (pixels[i] == 0) continue;
        if (seen++ % step == step / 2) indices.push_back(i);
    }
    return indices;
}

}  // namespace verdigris
