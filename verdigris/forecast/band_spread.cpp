// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_spread.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verdigris/forecast/context_pixels.h"

namespace verdigris {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd withheld(const Component& c) {
    const MatrixXd less = c.trend.weights.rowwise() - c.trend.weights.row(c.held);
    VectorXd out = (less * c.increments).cwiseProduct(less).rowwise().sum();
    out.head(c.held + 1).setZero();
    return out;
}

VectorXd expected_advantage(const std::vector<Component>& components,
                            const std::function<bool(const Component&)>& counts) {
    const auto units = Eigen::Index(kTrendUnits.size());
    VectorXd gain = VectorXd::Zero(units), variance = VectorXd::Zero(units);
    for (const Component& c : components) {
        if (!counts(c)) continue;
        // |truth|^2 - |truth - forecast|^2 = |forecast|^2 + 2 forecast * error of it
        gain += c.trend.change;
        variance += 4 / c.count * c.trend.change.cwiseProduct(c.trend.error);
    }
    VectorXd out(units);
    for (Eigen::Index u = 0; u < units; ++u)
        out[u] = variance[u] > 0 ? gain[u] / std::sqrt(variance[u])
                                 : std::numeric_limits<double>::infinity();
    return out;
}

Spread spread_of(const Mask& moving, const Components& components) {
    const auto units = Eigen::Index(kTrendUnits.size());
    VectorXd common = VectorXd::Zero(units), own = VectorXd::Zero(units);
    for (const Component& c : components.all)
        (c.common ? common : own) += c.trend.error + withheld(c);
    Spread spread;
    const SrgbF e = components.global_energy;
    const float mean = (e.r + e.g + e.b) / 3;
    if (mean > 0) spread.common = {e.r / mean, e.g / mean, e.b / mean};
    double sum = 0;
    const auto pixels = components.local_energy.pixels();
    for (const SrgbF& p : pixels) sum += double(p.r) + double(p.g) + double(p.b);
    const double inside = double(count_inside(moving));
    const float scale = sum > 0 ? float(3 * inside / sum) : 0;
    spread.own = Image<SrgbF>(moving.width(), moving.height());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (moving.pixels()[i] == 0) continue;
        // A pixel that kept still is not sure to do so: half of its share is everybody's.
        const auto share = [&](float energy) { return 0.5f + 0.5f * scale * energy; };
        spread.own.pixels()[i] = {share(pixels[i].r), share(pixels[i].g), share(pixels[i].b)};
    }
    for (Eigen::Index u = 0; u < units; ++u)
        spread.nodes.push_back({kTrendUnits[std::size_t(u)], common[u], own[u]});
    return spread;
}

}  // namespace verdigris
