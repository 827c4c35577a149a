// SPDX-License-Identifier: MIT
#include "verdigris/forecast/trend_models.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace verdigris {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The grid. chosen: coarse steps over all that is plausible; finer ones change forecasts by less
// than a hundredth (docs/models/bandtrend.md has the sensitivity).
struct Slowing {
    double kappa, prior;
};
constexpr Slowing kSlowing[] = {{0, .15}, {.02, .20}, {.05, .25}, {.1, .20}, {.2, .12}, {.5, .08}};
constexpr double kWandering[] = {0, .3, .6, .8, .92, .98, 1};
constexpr double kBending[] = {.5, .75, .85, .92, .96, .99};
constexpr double kNoise[] = {0, .001, .01, .1, 1, 10};
constexpr double kWalk = .1;                     // and of a level that walks at random
constexpr double kNegligible = 1e-9;             // weight of a model
constexpr double kUnlikely = 1e-3;               // of one that is not told of
constexpr double kEventSize[] = {10, 1e3, 1e5};  // variance, of V

}  // namespace

TrendModels::TrendModels(int increments, const TrendPrior& prior)
    : increments_(increments), prior_(prior) {
    const int q = increments;
    const bool events = prior.event > 0;
    for (int i = 0; events && i < q; ++i) events_.push_back({VectorXd::Unit(q, i), i + 1, false});
    for (int i = 1; events && i < q; ++i)
        events_.push_back({VectorXd::Unit(q, i - 1) - VectorXd::Unit(q, i), i, true});

    const std::vector<Slowing> slowings =
        prior.slowing && prior.drift
            ? std::vector<Slowing>(std::begin(kSlowing), std::end(kSlowing))
            : std::vector<Slowing>{{0, 1}};
    const std::vector<double> noises =
        prior.noise ? std::vector<double>(std::begin(kNoise), std::end(kNoise))
                    : std::vector<double>{0};
    const auto add_family = [&](bool bends, double rho, const Slowing& slowing, double weight) {
        TrendKind kind{TrendShape::drift, bends, rho, slowing.kappa};
        const DriftMoments drift = drift_moments(kind, q, prior.doubt);
        for (const double eta : noises) {
            kind.eta = eta;
            add(kind, with_noise(drift, eta), weight * slowing.prior / double(noises.size()));
        }
    };
    const bool bending = prior.bending && prior.drift;
    const std::size_t wandering = prior.drift ? std::size(kWandering) : 1;  // the first: rho of 0
    const double share = 1.0 / double(wandering + (bending ? std::size(kBending) : 0));
    for (const Slowing& slowing : slowings) {
        for (std::size_t i = 0; i < wandering; ++i)
            add_family(false, kWandering[i], slowing, share);
        if (!bending) continue;
        for (const double rho : kBending) add_family(true, rho, slowing, share);
    }
    add({TrendShape::walk}, walk_moments(q), kWalk);
    if (prior.noise) add({TrendShape::level, false, 0, 0, 1}, level_moments(q), prior.level);
}

void TrendModels::add(const TrendKind& kind, const TrendMoments& moments, double prior) {
    const Eigen::LLT<MatrixXd> cholesky(moments.covariance);
    Model m;
    m.kind = kind;
    m.precision = cholesky.solve(MatrixXd::Identity(increments_, increments_));
    m.log_determinant = 2 * cholesky.matrixLLT().diagonal().array().log().sum();
    m.weights = moments.with_future * m.precision;
    m.unexplained =
        (moments.future - m.weights.cwiseProduct(moments.with_future).rowwise().sum()).cwiseMax(0);
    m.log_prior = std::log(prior);
    m.at_events.resize(increments_, Eigen::Index(events_.size()));
    m.of_events.resize(Eigen::Index(events_.size()));
    m.log_denominators.resize(events_.size());
    for (std::size_t e = 0; e < events_.size(); ++e) {
        m.at_events.col(Eigen::Index(e)) = m.precision * events_[e].direction;
        m.of_events[Eigen::Index(e)] = events_[e].direction.dot(m.at_events.col(Eigen::Index(e)));
        for (std::size_t i = 0; i < std::size(kEventSize); ++i)
            m.log_denominators[e][i] = std::log1p(kEventSize[i] * m.of_events[Eigen::Index(e)]);
    }
    models_.push_back(std::move(m));
}

Trend TrendModels::trend(const MatrixXd& gram, double count) const {
    const double q = increments_, scale = std::max(gram.trace() / q, 1e-30);
    const MatrixXd g = gram / scale;  // no underflow, whatever the unit
    const std::size_t sizes = std::size(kEventSize), events = events_.size();
    const double log_event = std::log(std::max(prior_.event, 1e-300) / double(sizes));
    // Of a model, and of it with each event at each size (Sherman and Morrison 1950).
    std::vector<double> evidence, seen_by_event;
    evidence.reserve(models_.size() * (1 + events * sizes));
    seen_by_event.reserve(models_.size() * events);
    const auto log_evidence = [&](double variance, double log_determinant) {
        return -0.5 * count * (q * std::log(std::max(variance, 1e-12)) + log_determinant);
    };
    MatrixXd at_gram(increments_, Eigen::Index(events));
    for (const Model& m : models_) {
        const double all = (m.precision.array() * g.array()).sum();
        evidence.push_back(log_evidence(all / q, m.log_determinant) + m.log_prior);
        at_gram.noalias() = g * m.at_events;
        for (std::size_t e = 0; e < events; ++e) {
            const auto column = Eigen::Index(e);
            const double seen = m.at_events.col(column).dot(at_gram.col(column));
            const double of = m.of_events[column];
            seen_by_event.push_back(seen);
            for (std::size_t i = 0; i < sizes; ++i) {
                const double tau = kEventSize[i], denominator = 1 + tau * of;
                evidence.push_back(log_evidence((all - tau * seen / denominator) / q,
                                                m.log_determinant + m.log_denominators[e][i]) +
                                   m.log_prior + log_event);
            }
        }
    }
    const double best = *std::max_element(evidence.begin(), evidence.end());
    double total = 0;
    // Most are out of the question, and an exponential of them costs as much as any.
    for (double& e : evidence) total += e = e < best - 60 ? 0 : std::exp(e - best);

    // V is fitted to count q values: as of a t distribution, its uncertainty widens the error.
    const double freedom = std::max(count * q, 3.0);
    const double widened = freedom / (freedom - 2);
    const auto units = Eigen::Index(kTrendUnits.size());
    Trend out;
    out.weights = MatrixXd::Zero(units, increments_);
    VectorXd square = VectorXd::Zero(units), left = VectorXd::Zero(units);
    std::vector<double> of_event(events, 0);
    std::size_t k = 0, k_seen = 0;
    for (const Model& m : models_) {
        const auto from = evidence.begin() + std::ptrdiff_t(k);
        const auto to = from + std::ptrdiff_t(1 + events * sizes);
        if (std::all_of(from, to, [&](double e) { return e < kNegligible * total; })) {
            k += 1 + events * sizes;
            k_seen += events;
            continue;
        }
        const double all = (m.precision.array() * g.array()).sum();
        const MatrixXd with_gram = m.weights * g;
        const VectorXd plain = with_gram.cwiseProduct(m.weights).rowwise().sum();
        double of_model = evidence[k++] / total, variance = of_model * all / q;
        if (of_model > kNegligible) {
            square += of_model * plain;
            left += of_model * all / q * m.unexplained;
        }
        for (std::size_t e = 0; e < events; ++e) {
            const auto column = Eigen::Index(e);
            const double seen = seen_by_event[k_seen++];
            for (const double tau : kEventSize) {
                const double p = evidence[k++] / total;
                if (p < kNegligible) continue;
                of_model += p;
                of_event[e] += p;
                const auto at = m.at_events.col(column);
                const VectorXd toward = m.weights * events_[e].direction;
                const double share = tau / (1 + tau * m.of_events[column]);
                out.weights -= (p * share) * toward * at.transpose();
                square += p * (plain - 2 * share * toward.cwiseProduct(with_gram * at) +
                               share * share * seen * toward.cwiseAbs2());
                left += p * (all - share * seen) / q * (m.unexplained + share * toward.cwiseAbs2());
                variance += p * (all - share * seen) / q;
            }
        }
        out.weights += of_model * m.weights;
        if (of_model >= kUnlikely)
            out.likely.push_back({m.kind, of_model, scale * widened * variance / of_model});
    }
    out.change = scale * (out.weights * g).cwiseProduct(out.weights).rowwise().sum();
    out.error = (scale * square - out.change).cwiseMax(0) + scale * widened * left;
    for (std::size_t e = 0; e < events; ++e) out.event += of_event[e];
    if (events == 0) return out;
    const auto likeliest = std::max_element(of_event.begin(), of_event.end()) - of_event.begin();
    out.event_frame = events_[std::size_t(likeliest)].frame;
    out.outlier = events_[std::size_t(likeliest)].outlier;
    return out;
}

}  // namespace verdigris
