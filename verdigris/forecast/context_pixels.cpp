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

/// SplitMix64: numbers without a pattern that are the same in every run.
std::uint64_t mixed(std::uint64_t key) {
    key += 0x9E3779B97F4A7C15u;
    key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9u;
    key = (key ^ (key >> 27)) * 0x94D049BB133111EBu;
    return key ^ (key >> 31);
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
    for (const Mask* mask : {&context.specimen, &context.clipped, &context.backdrop}) {
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

Mask specimen_of(const Context& context) {
    Mask mask = moving_mask(context);
    const auto backdrop = context.backdrop.pixels();
    for (std::size_t i = 0; i < backdrop.size(); ++i)
        if (backdrop[i] != 0) mask.pixels()[i] = 0;
    return mask;
}

std::int64_t count_inside(const Mask& mask) {
    const auto pixels = mask.pixels();
    return std::count_if(pixels.begin(), pixels.end(), [](std::uint8_t v) { return v != 0; });
}

std::vector<std::size_t> sample_inside(const Mask& mask, std::int64_t limit) {
    const std::int64_t inside = count_inside(mask), count = std::min(inside, limit);
    std::vector<std::size_t> indices;
    indices.reserve(std::size_t(count));
    const auto pixels = mask.pixels();
    // The rank, among the pixels inside, of the one that stratum k gives.
    const auto rank = [&](std::int64_t k) {
        const std::int64_t begin = k * inside / count, end = (k + 1) * inside / count;
        return begin + std::int64_t(mixed(std::uint64_t(k)) % std::uint64_t(end - begin));
    };
    std::int64_t seen = 0, taken = 0;
    for (std::size_t i = 0; taken < count; ++i) {
        if (pixels[i] == 0) continue;
        if (seen++ != rank(taken)) continue;
        indices.push_back(i);
        ++taken;
    }
    return indices;
}

}  // namespace verdigris
