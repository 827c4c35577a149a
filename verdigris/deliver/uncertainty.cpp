// SPDX-License-Identifier: MIT
#include "verdigris/deliver/uncertainty.h"

#include <fmt/format.h>

#include <cmath>

namespace verdigris {
namespace {

std::string codes(double value) {
    const double c = 255 * value;
    return c < 0.95 ? fmt::format("{:.1f}", c) : fmt::format("{:.0f}", c);
}

}  // namespace

std::string codes_text(double value) {
    const double c = 255 * value;
    return c < 9.95 ? fmt::format("{:.1f}", c) : fmt::format("{:.0f}", c);
}

std::vector<Uncertainty> uncertainty_of(const Delivery& delivery) {
    std::vector<Uncertainty> list;
    const Spread& spread = delivery.forecast->spread;
    if (!spread.known()) return list;
    for (const double h : delivery.horizons) {
        const SpreadNode at = spread.at(h);
        const double mean = std::sqrt(at.common), pixel = std::sqrt(at.common + at.own);
        list.push_back({h, kMeanHalfWidth80 * mean, kMeanHalfWidth95 * mean, kHalfWidth80 * pixel,
                        kHalfWidth95 * pixel});
    }
    return list;
}

std::string uncertainty_sentence(const std::vector<Uncertainty>& list) {
    if (list.empty()) return "";
    const auto part = [](const Uncertainty& u) {
        return fmt::format("{} codes of 255 (a pixel: {}) at +{:g}", codes(u.mean80),
                           codes(u.pixel80), u.horizon);
    };
    std::string text =
        "Nominally four times in five, the mean color is off by at most " + part(list.front());
    if (list.size() > 1) text += ", and by " + part(list.back());
    return text + ".";
}

}  // namespace verdigris
