// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/forecast/context_pixels.h"

namespace verdigris {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLightCount = 1;  // chosen: the channels share nearly all of it
constexpr double kNudge = 0.01;    // of light, to see what a change of it does to a picture

/// Mean square over what moves of the change of encoded values per unit of log light.
double light_slope(const Image<SrgbF>& frame, const Mask& moving) {
    const Image<SrgbF> brighter = relit(frame, {1 + kNudge, 1 + kNudge, 1 + kNudge});
    return mean_square_difference(frame, brighter, moving) /
           (std::log1p(kNudge) * std::log1p(kNudge));
}

/// Variance of log light between the last frame and each of kTrendUnits; zero without a backdrop.
VectorXd light_variance(const Context& context, TrendModelsCache& models) {
    const auto light = backdrop_light(context);
    const auto q = Eigen::Index(light.size()) - 1;
    MatrixXd steps(q, 3);
    for (Eigen::Index i = 0; i < q; ++i)
        for (int k = 0; k < 3; ++k)
            steps(i, k) = std::log(light[std::size_t(i)][std::size_t(k)]) -
                          std::log(light[std::size_t(i) + 1][std::size_t(k)]);
    const MatrixXd gram = steps * steps.transpose() / 3;
    if (!(gram.trace() > 0)) return VectorXd::Zero(Eigen::Index(kTrendUnits.size()));
    const Trend trend = models.of(int(q)).trend(gram, kLightCount);
    return trend.change + trend.error;  // the light is held, so that its trend is an error too
}

/// Mean square of what a component still changes after it is held.
VectorXd withheld(const Component& c) {
    const MatrixXd less = c.trend.weights.rowwise() - c.trend.weights.row(c.held);
    VectorXd out = (less * c.increments).cwiseProduct(less).rowwise().sum();
    out.head(c.held + 1).setZero();
    return out;
}

}  // namespace

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

Spread spread_of(const Context& context, const Mask& moving, const Components& components,
                 TrendModelsCache& models) {
    const auto units = Eigen::Index(kTrendUnits.size());
    VectorXd common = light_slope(context.frames.back(), moving) * light_variance(context, models);
    VectorXd own = VectorXd::Zero(units);
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
