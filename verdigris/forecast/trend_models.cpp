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
    for (int i = 0; events && i < q; ++i) events_.push_back({i, i + 1, false});
    for (int i = 1; events && i < q; ++i) events_.push_back({i, i, true});

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
    const std::size_t families = wandering + (bending ? std::size(kBending) : 0);
    const std::size_t most = slowings.size() * families * noises.size() + 2;
    models_.reserve(most);
    precisions_.resize(q, Eigen::Index(most) * q);
    log_determinants_.resize(Eigen::Index(most * variants()));
    log_priors_.resize(log_determinants_.size());
    const double share = 1.0 / double(families);
    for (const Slowing& slowing : slowings) {
        for (std::size_t i = 0; i < wandering; ++i)
            add_family(false, kWandering[i], slowing, share);
        if (!bending) continue;
        for (const double rho : kBending) add_family(true, rho, slowing, share);
    }
    add({TrendShape::walk}, walk_moments(q), kWalk);
    if (prior.noise) add({TrendShape::level, false, 0, 0, 1}, level_moments(q), prior.level);
    const auto made = Eigen::Index(models_.size());
    precisions_.conservativeResize(q, made * q);
    log_determinants_.conservativeResize(made * Eigen::Index(variants()));
    log_priors_.conservativeResize(made * Eigen::Index(variants()));
}

std::size_t TrendModels::variants() const {
    return 1 + events_.size() * std::size(kEventSize);
}

VectorXd TrendModels::along(const Eigen::Ref<const MatrixXd>& matrix, const Event& event) {
    if (event.outlier) return matrix.col(event.increment - 1) - matrix.col(event.increment);
    return matrix.col(event.increment);
}

Eigen::Ref<const MatrixXd> TrendModels::precision(std::size_t model) const {
    return precisions_.middleCols(Eigen::Index(model) * increments_, increments_);
}

void TrendModels::add(const TrendKind& kind, const TrendMoments& moments, double prior) {
    const std::size_t at = models_.size();
    const Eigen::LLT<MatrixXd> cholesky(moments.covariance);
    const MatrixXd precision = cholesky.solve(MatrixXd::Identity(increments_, increments_));
    precisions_.middleCols(Eigen::Index(at) * increments_, increments_) = precision;
    const double log_determinant = 2 * cholesky.matrixLLT().diagonal().array().log().sum();
    Model m;
    m.kind = kind;
    m.weights = moments.with_future * precision;
    m.unexplained =
        (moments.future - m.weights.cwiseProduct(moments.with_future).rowwise().sum()).cwiseMax(0);
    m.of_events.resize(Eigen::Index(events_.size()));
    const double log_event =
        std::log(std::max(prior_.event, 1e-300) / double(std::size(kEventSize)));
    auto k = Eigen::Index(at * variants());
    const auto add_variant = [&](double determinant, double log_prior) {
        log_determinants_[k] = log_determinant + determinant;
        log_priors_[k++] = std::log(prior) + log_prior;
    };
    add_variant(0, 0);
    for (std::size_t e = 0; e < events_.size(); ++e) {
        const VectorXd here = along(precision, events_[e]);
        const Eigen::Index i = events_[e].increment;
        const double of = events_[e].outlier ? here[i - 1] - here[i] : here[i];
        m.of_events[Eigen::Index(e)] = of;
        for (const double tau : kEventSize) add_variant(std::log1p(tau * of), log_event);
    }
    models_.push_back(std::move(m));
}

MatrixXd TrendModels::seen_by_events(const MatrixXd& gram) const {
    MatrixXd seen(Eigen::Index(events_.size()), Eigen::Index(models_.size()));
    if (events_.empty()) return seen;
    const MatrixXd with_gram = gram * precisions_;
    VectorXd beside(increments_);
    for (std::size_t m = 0; m < models_.size(); ++m) {
        const auto at = Eigen::Index(m) * increments_;
        const auto p = precisions_.middleCols(at, increments_);
        const auto pg = with_gram.middleCols(at, increments_);
        auto out = seen.col(Eigen::Index(m));
        for (Eigen::Index i = 0; i < increments_; ++i) out[i] = p.col(i).dot(pg.col(i));
        for (Eigen::Index i = 1; i < increments_; ++i)
            out[increments_ + i - 1] = out[i - 1] + out[i] - 2 * p.col(i - 1).dot(pg.col(i));
    }
    return seen;
}

Trend TrendModels::trend(const MatrixXd& gram, double count) const {
    const double q = increments_, scale = std::max(gram.trace() / q, 1e-30);
    const MatrixXd g = gram / scale;  // no underflow, whatever the unit
    const std::size_t events = events_.size();
    // Of a model, and of it with each event at each size (Sherman and Morrison 1950).
    const MatrixXd seen_by_event = seen_by_events(g);
    VectorXd alone(Eigen::Index(models_.size()));
    Eigen::ArrayXd evidence(log_priors_.size());  // the sum of squares first
    for (std::size_t i = 0, k = 0; i < models_.size(); ++i) {
        const auto m = Eigen::Index(i);
        const VectorXd& of_events = models_[i].of_events;
        const double all = alone[m] = precision(i).cwiseProduct(g).sum();
        evidence[Eigen::Index(k++)] = all;
        for (Eigen::Index e = 0; e < Eigen::Index(events); ++e)
            for (const double tau : kEventSize)
                evidence[Eigen::Index(k++)] =
                    all - tau * seen_by_event(e, m) / (1 + tau * of_events[e]);
    }
    evidence =
        -0.5 * count * (q * (evidence / q).max(1e-12).log() + log_determinants_) + log_priors_;
    const double best = evidence.maxCoeff();
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
    for (std::size_t i = 0; i < models_.size(); ++i) {
        const Model& m = models_[i];
        const auto of_variants = Eigen::Index(variants());
        const auto here = evidence.segment(Eigen::Index(i) * of_variants, of_variants) / total;
        if ((here < kNegligible).all()) continue;
        const double all = alone[Eigen::Index(i)];
        const MatrixXd with_gram = m.weights * g;
        const VectorXd plain = with_gram.cwiseProduct(m.weights).rowwise().sum();
        Eigen::Index k = 0;
        double of_model = here[k++], variance = of_model * all / q;
        if (of_model > kNegligible) {
            square += of_model * plain;
            left += of_model * all / q * m.unexplained;
        }
        for (std::size_t e = 0; e < events; ++e) {
            const auto column = Eigen::Index(e);
            const double seen = seen_by_event(column, Eigen::Index(i));
            for (const double tau : kEventSize) {
                const double p = here[k++];
                if (p < kNegligible) continue;
                of_model += p;
                of_event[e] += p;
                const VectorXd at = along(precision(i), events_[e]);
                const VectorXd toward = along(m.weights, events_[e]);
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
