// SPDX-License-Identifier: MIT
#include "verdigris/forecast/observed_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/forecast/context_pixels.h"

namespace verdigris {
namespace {

constexpr double kPercentile = 0.01;

struct Range {
    float low = 0, high = 1;
};

/// Of one channel over the pixels that count; [0, 1] if there are none.
Range range_of(const Context& context, const Mask& counts, float SrgbF::*channel, double margin) {
    std::vector<float> values;
    for (const Image<SrgbF>& frame : context.frames)
        for (std::size_t i = 0; i < frame.pixel_count(); ++i)
            if (counts.pixels()[i] != 0) values.push_back(frame.pixels()[i].*channel);
    if (values.empty()) return {};
    const auto at = [&](double share) {
        const auto rank = std::ptrdiff_t(std::lround(share * double(values.size() - 1)));
        std::ranges::nth_element(values, values.begin() + rank);
        return double(values[std::size_t(rank)]);
    };
    const double low = at(kPercentile), high = at(1 - kPercentile), more = margin * (high - low);
    return {float(std::max(0.0, low - more)), float(std::min(1.0, high + more))};
}

}  // namespace

Forecaster within_observed_range(Forecaster inner, std::vector<double> horizons, double margin) {
    if (!(margin >= 0)) throw Error(ErrorCode::usage, "the margin of a range must be 0 or more");
    const bool rising =
        std::ranges::adjacent_find(horizons, std::greater_equal<>()) == horizons.end();
    if (horizons.empty() || !rising || !(horizons.front() > 0))
        throw Error(ErrorCode::usage, "a range is kept at horizons that increase from above 0");
    std::string name = inner.name + " in range";
    return {name, [=](const Context& context) {
                check_context(context);
                Mask counts = moving_mask(context);
                for (std::size_t i = 0; !context.backdrop.empty() && i < counts.pixel_count(); ++i)
                    if (context.backdrop.pixels()[i] != 0) counts.pixels()[i] = 0;
                constexpr std::array<float SrgbF::*, 3> kChannels{&SrgbF::r, &SrgbF::g, &SrgbF::b};
                std::array<Range, 3> ranges;
                for (std::size_t c = 0; c < 3; ++c)
                    ranges[c] = range_of(context, counts, kChannels[c], margin);
                const Forecast free = inner.forecast(context);
                Forecast out;
                out.forecaster = name;
                out.explanation = free.explanation + " Kept inside the colors observed.";
                out.context_length = free.context_length;
                out.guards = free.guards;
                out.stack.horizons = horizons;
                out.stack.base = context.frames.back().clone();
                for (const double h : horizons) {
                    Image<SrgbF> frame = free.at(h);
                    for (std::size_t i = 0; i < frame.pixel_count(); ++i) {
                        const SrgbF base = out.stack.base.pixels()[i];
                        for (std::size_t c = 0; c < 3; ++c) {
                            float& v = frame.pixels()[i].*kChannels[c];
                            const float b = base.*kChannels[c];
                            v = std::clamp(v, std::min(ranges[c].low, b),
                                           std::max(ranges[c].high, b));
                        }
                    }
                    out.stack.frames.push_back(std::move(frame));
                }
                return out;
            }};
}

}  // namespace verdigris
