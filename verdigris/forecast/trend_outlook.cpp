// SPDX-License-Identifier: MIT
#include "verdigris/forecast/trend_outlook.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace verdigris {
namespace {

/// Of one model at V = 1, the noise of the frame to come taken off.
double error_left(const TrendMoments& m, double eta) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(m.covariance);
    double sum = 0;
    const Eigen::MatrixXd weights =
        cholesky.solve(m.with_future.topRows(kOutlookUnits).transpose()).transpose();
    for (Eigen::Index u = 0; u < kOutlookUnits; ++u)
        sum += std::max(0.0, m.future[u] - weights.row(u).dot(m.with_future.row(u)) - eta);
    return sum / kOutlookUnits;
}

}  // namespace

const DriftMoments& TrendOutlook::part(const TrendKind& kind, int increments) {
    const auto [at, is_new] = drifts_.try_emplace(
        {kind.bending, kind.rho, kind.kappa, kind.period, kind.walked, kind.age, increments});
    if (is_new) at->second = part_moments(kind, increments, doubt_);
    return at->second;
}

double TrendOutlook::error_of(const TrendKind& kind, const Circumstances& c) {
    if (kind.shape == TrendShape::walk) return error_left(walk_moments(c.increments), 0);
    if (kind.shape == TrendShape::level) {
        const double eta = std::max(c.noise, 1e-6);
        return error_left(level_moments(c.increments, eta), eta);
    }
    // What slows down is smaller later on, and noise is not. What speeds up is not counted on to be
    // larger by then, nor is what walks.
    const auto later = [&](const TrendKind& part) {
        const double size = std::min(1.0, drift_size(part, c.later));
        return size * size;
    };
    const DriftMoments& first = part(kind, c.increments);
    const auto left = [&](const DriftMoments& drift, double size) {
        const double eta = kind.eta * c.noise / size;
        return size * error_left(with_noise(drift, eta), eta);
    };
    if (kind.second_share == 0) return left(first, later(kind));
    const double of_second = kind.second_share * later(second_part(kind)),
                 size = (1 - kind.second_share) * later(kind) + of_second;
    return left(together(first, part(second_part(kind), c.increments), of_second / size), size);
}

double TrendOutlook::expected_error(const Trend& trend, const Circumstances& circumstances) {
    double sum = 0, weight = 0;
    for (const LikelyKind& likely : trend.likely) {
        sum += likely.probability * likely.variance * error_of(likely.kind, circumstances);
        weight += likely.probability;
    }
    return weight > 0 ? sum / weight : 0;
}

double frame_noise(const Trend& trend) {
    double sum = 0, weight = 0;
    for (const LikelyKind& likely : trend.likely) {
        sum += likely.probability * likely.variance * likely.kind.eta;
        weight += likely.probability;
    }
    return weight > 0 ? sum / weight : 0;
}

}  // namespace verdigris
