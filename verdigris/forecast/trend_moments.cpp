// SPDX-License-Identifier: MIT
#include "verdigris/forecast/trend_moments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace verdigris {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTrusted = 50;  // units after which a drift may as well be another one
constexpr double kFloor = 1e-4;  // variance that no model explains, of V
// chosen: units for which what speeds up goes on to. Exponential growth is short of something soon.
constexpr double kSpeedsUp = 3;

// chosen: half a unit before the middle of its first increment a layer is as good as new, and a
// drift has not begun to walk.
constexpr double kNew = 0.5;

/// Of the drift at two times, in units after the last frame.
double covariance_at(const TrendKind& kind, double one, double other) {
    if (kind.walked > 0) return std::max(kind.walked + std::min(one, other), kNew) / kind.walked;
    const double lag = std::abs(one - other);
    const double fall = lag == 0 ? 1 : std::pow(kind.rho, lag);
    if (kind.period > 0) return std::cos(2 * std::numbers::pi * lag / kind.period) * fall;
    return kind.bending ? (1 - std::log(kind.rho) * lag) * fall : fall;
}

/// Variance of what a drift adds up to, for kTrendUnits ahead.
VectorXd variance_ahead(const TrendKind& kind, double doubt) {
    const int last = int(kTrendUnits.back());
    // Of increments that end there: all but a drift that walks depends on the lag alone.
    std::vector<double> covariance, size;
    for (int lag = 0; lag <= last; ++lag) {
        covariance.push_back(covariance_at(kind, 0, lag));
        size.push_back(drift_size(kind, lag) * std::exp(-doubt * lag));
    }
    const auto between = [&](int i, int j) {
        return kind.walked > 0 ? covariance_at(kind, i, j) : covariance[std::size_t(j - i)];
    };
    VectorXd out(Eigen::Index(kTrendUnits.size()));
    double sum = 0;
    for (int ahead = 1, u = 0; ahead <= last; ++ahead) {
        double with_earlier = 0;
        for (int i = 1; i < ahead; ++i) with_earlier += size[std::size_t(i)] * between(i, ahead);
        const double now = size[std::size_t(ahead)];
        sum += now * (2 * with_earlier + now * between(ahead, ahead));
        if (ahead == int(kTrendUnits[std::size_t(u)])) out[u++] = sum;
    }
    return out;
}

/// Of differences of white noise of variance 1.
MatrixXd noise_of_increments(int q) {
    MatrixXd t = 2 * MatrixXd::Identity(q, q);
    for (int i = 0; i + 1 < q; ++i) t(i, i + 1) = t(i + 1, i) = -1;
    return t;
}

VectorXd units_ahead() {
    return Eigen::Map<const VectorXd>(kTrendUnits.data(), Eigen::Index(kTrendUnits.size()));
}

}  // namespace

double drift_size(const TrendKind& kind, double ahead) {
    const double counted = kind.kappa < 0 ? std::min(ahead, kSpeedsUp) : ahead;
    const double slower = kind.age > 0 ? std::sqrt(kind.age / std::max(kind.age + ahead, kNew)) : 1;
    return slower * std::exp(-kind.kappa * counted);
}

TrendKind second_part(const TrendKind& kind) {
    TrendKind second = kind;
    second.kappa = kind.second_kappa;
    second.second_share = second.second_kappa = 0;
    return second;
}

DriftMoments together(const DriftMoments& first, const DriftMoments& second, double second_share) {
    const double s = second_share;
    return {(1 - s) * first.drift + s * second.drift, (1 - s) * first.future + s * second.future,
            (1 - s) * first.ahead + s * second.ahead};
}

DriftMoments drift_moments(const TrendKind& kind, int q, double doubt) {
    if (kind.second_share == 0) return part_moments(kind, q, doubt);
    return together(part_moments(kind, q, doubt), part_moments(second_part(kind), q, doubt),
                    kind.second_share);
}

DriftMoments part_moments(const TrendKind& kind, int q, double doubt) {
    const int units = int(kTrendUnits.size());
    DriftMoments out{MatrixXd(q, q), MatrixXd::Zero(units, q), {}};
    const auto size = [&](double back) { return drift_size(kind, -back); };
    for (int i = 0; i < q; ++i) {
        for (int j = 0; j < q; ++j) {
            out.drift(i, j) =
                size(q - 1 - i) * size(q - 1 - j) * covariance_at(kind, i - q + 1, j - q + 1);
        }
        // Summed unit by unit up to each of kTrendUnits.
        double sum = 0;
        for (int u = 0, ahead = 1; u < units; ++u) {
            for (; ahead <= int(kTrendUnits[std::size_t(u)]); ++ahead)
                sum += size(q - 1 - i) * size(-ahead) * std::exp(-doubt * ahead) *
                       covariance_at(kind, i - q + 1, ahead);
            out.future(u, i) = sum;
        }
    }
    const VectorXd doubted = 1 - (-(units_ahead() / kTrusted).array().cube()).exp();
    const VectorXd drifting = variance_ahead(kind, doubt);
    out.ahead = drifting + doubted.cwiseProduct(variance_ahead(kind, 0));
    return out;
}

TrendMoments with_noise(const DriftMoments& drift, double eta) {
    const auto q = drift.drift.rows();
    TrendMoments m;
    m.with_future = drift.future;
    m.with_future.col(q - 1).array() -= eta;  // the last frame's noise goes away again
    m.covariance =
        drift.drift + eta * noise_of_increments(int(q)) + kFloor * MatrixXd::Identity(q, q);
    m.future =
        drift.ahead + VectorXd::Constant(drift.ahead.size(), 2 * eta) + kFloor * units_ahead();
    return m;
}

TrendMoments walk_moments(int q) {
    const auto units = Eigen::Index(kTrendUnits.size());
    return {MatrixXd::Identity(q, q), MatrixXd::Zero(units, q), units_ahead()};
}

TrendMoments level_moments(int q, double eta) {
    const auto units = Eigen::Index(kTrendUnits.size());
    TrendMoments m{eta * noise_of_increments(q) + 10 * kFloor * MatrixXd::Identity(q, q),
                   MatrixXd::Zero(units, q),
                   {}};
    m.with_future.col(q - 1).setConstant(-eta);
    m.future = VectorXd::Constant(units, 2 * eta) + 10 * kFloor * units_ahead();
    return m;
}

}  // namespace verdigris
