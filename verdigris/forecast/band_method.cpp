// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_method.h"

#include <algorithm>
#include <functional>

#include "verdigris/forecast/band_spread.h"
#include "verdigris/forecast/context_pixels.h"

namespace verdigris {
namespace {

/// The last of kTrendUnits until which those that count are confident to beat holding still; the
/// first at least, because that also takes the last frame's noise back.
int trusted_until(const std::vector<Component>& components, double confidence,
                  const std::function<bool(const Component&)>& counts) {
    const Eigen::VectorXd advantage = expected_advantage(components, counts);
    int last = -1;
    while (last + 1 < int(advantage.size()) && advantage[last + 1] >= confidence) ++last;
    return std::max(last, 0);
}

/// All is followed while all together is sure enough. Light that jitters is never sure, and what it
/// leaves may well be: light, and all but it, are each followed as long as they are by themselves.
void hold(std::vector<Component>& components, double confidence) {
    const int all = trusted_until(components, confidence, [](const Component&) { return true; });
    for (const bool light : {true, false}) {
        const int own = trusted_until(components, confidence,
                                      [light](const Component& c) { return c.light == light; });
        for (Component& c : components)
            if (c.light == light) c.held = std::max(all, own);
    }
}

}  // namespace

Components held_components(const Context& context, const Mask& moving, BandMethod& method) {
    Components components = components_of(context, moving, method.design, method.models);
    if (!components.all.empty()) hold(components.all, method.design.confidence);
    return components;
}

Context part_of(const Context& context, int begin, int count) {
    Context part;
    for (int i = begin; i < begin + count; ++i)
        part.frames.push_back(context.frames[std::size_t(i)].clone());
    if (!context.specimen.empty()) part.specimen = context.specimen.clone();
    if (!context.clipped.empty()) part.clipped = context.clipped.clone();
    if (!context.backdrop.empty()) part.backdrop = context.backdrop.clone();
    part.sigma = context.sigma;
    part.tau = context.tau;
    return part;
}

}  // namespace verdigris
