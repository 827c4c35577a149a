// SPDX-License-Identifier: MIT
#include "verdigris/forecast/trend_models.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace verdigris {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixX2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// The grid. chosen: coarse steps over all that is plausible; finer ones change forecasts by less
// than a hundredth (docs/models/bandtrend.md has the sensitivity).
// How a drift slows down: not at all, toward an end, or as a layer does that grows through itself
// and was so many units old at the first increment.
struct Slowing {
    double kappa, age, prior;
};
constexpr Slowing kSlowing[] = {{0, 0, .15},  {.05, 0, .2}, {.1, 0, .15},
                                {.3, 0, .15}, {0, 1, .2},   {0, 10, .15}};
// A drift that itself walks at random: units that it had walked for by the first increment, and how
// what drives it slows down.
constexpr double kWalked[] = {1, 10};
constexpr double kWalkSlowing[] = {0, .05, .2};
constexpr double kWalking = .1;  // prior weight of all of them
// Drifts of two parts. chosen: one that slows down, or not, beside one that speeds up, as corrosion
// does that spreads; and two that slow down at different paces.
struct TwoParts {
    double kappa, second_kappa, second_share;
};
constexpr TwoParts kTwoParts[] = {{0, -.1, .1},  {.1, -.1, .1}, {.3, -.1, .1}, {0, -.1, .5},
                                  {.1, -.1, .5}, {.3, -.1, .5}, {0, .1, .5},   {0, .3, .5},
                                  {.1, .3, .5},  {0, .1, .9},   {0, .3, .9},   {.1, .3, .9}};
constexpr double kTwo = .3;  // prior weight of all of them
constexpr double kWandering[] = {0, .3, .6, .8, .92, .98, 1};
constexpr double kBending[] = {.5, .75, .85, .92, .96, .99};
// Swings: frequencies as far apart as ten frames tell them, from a period of 20 units to one of 3.
constexpr double kFrequency[] = {.05, .085, .12, .155, .19, .225, .26, .295, .33};
constexpr double kSwinging[] = {.95, .99};  // rho
constexpr double kNoiseOfSwings[] = {0, .01, 1};
constexpr double kSwing = .5;  // prior weight of all of them
constexpr double kNoise[] = {0, .001, .01, .1, 1, 10};
constexpr double kWalk = .1;                     // and of a level that walks at random
constexpr double kNegligible = 1e-9;             // weight of a model
constexpr double kOutOfTheQuestion = 30;         // log of how much less likely than the best
constexpr double kUnlikely = 1e-3;               // of one that is not told of
constexpr double kEventSize[] = {10, 1e3, 1e5};  // variance, of V
// Increments. With fewer, a swing or a step half-way would stand for any change at all.
constexpr int kFewestForRare = 4;

}  // namespace

TrendModels::TrendModels(int increments, const TrendPrior& prior)
    : increments_(increments), prior_(prior) {
    const int q = increments;
    if (prior.event > 0) add_events();

    const std::vector<Slowing> slowings =
        prior.slowing && prior.drift
            ? std::vector<Slowing>(std::begin(kSlowing), std::end(kSlowing))
            : std::vector<Slowing>{{0, 0, 1}};
    const std::vector<double> noises =
        prior.noise ? std::vector<double>(std::begin(kNoise), std::end(kNoise))
                    : std::vector<double>{0};
    const std::vector<double> noises_of_swings =
        prior.noise ? std::vector<double>(std::begin(kNoiseOfSwings), std::end(kNoiseOfSwings))
                    : std::vector<double>{0};
    const auto add_family = [&](TrendKind kind, double weight, const std::vector<double>& etas) {
        const DriftMoments drift = drift_moments(kind, q, prior.doubt);
        for (const double eta : etas) {
            kind.eta = eta;
            add(kind, with_noise(drift, eta), weight / double(etas.size()));
        }
    };
    const bool bending = prior.bending && prior.drift,
               swing = prior.swing && prior.drift && q >= kFewestForRare,
               two_parts = prior.two_parts && prior.slowing && prior.drift,
               walking = prior.walking && prior.drift;
    const std::size_t wandering = prior.drift ? std::size(kWandering) : 1;  // the first: rho of 0
    const std::size_t families = wandering + (bending ? std::size(kBending) : 0);
    const std::size_t most =
        (slowings.size() * families + std::size(kTwoParts) +
         std::size(kWalked) * std::size(kWalkSlowing)) *
            noises.size() +
        std::size(kSwinging) * std::size(kFrequency) * noises_of_swings.size() + 2;
    models_.reserve(most);
    precisions_.resize(q, Eigen::Index(most) * q);
    log_determinants_.resize(Eigen::Index(most * variants()));
    log_priors_.resize(log_determinants_.size());
    const double share = 1.0 / double(families);
    for (const Slowing& slowing : slowings) {
        TrendKind kind{TrendShape::drift};
        kind.kappa = slowing.kappa;
        kind.age = slowing.age > 0 ? slowing.age + q - 1 : 0;
        for (std::size_t i = 0; i < wandering; ++i) {
            kind.rho = kWandering[i];
            add_family(kind, share * slowing.prior, noises);
        }
        kind.bending = true;
        for (std::size_t i = 0; bending && i < std::size(kBending); ++i) {
            kind.rho = kBending[i];
            add_family(kind, share * slowing.prior, noises);
        }
    }
    const std::size_t slow = prior.slowing ? std::size(kWalkSlowing) : 1;  // the first: not at all
    for (std::size_t i = 0; walking && i < slow; ++i) {
        TrendKind kind{TrendShape::drift, false, 1, kWalkSlowing[i]};
        for (const double walked : kWalked) {
            kind.walked = walked + q - 1;
            add_family(kind, kWalking / double(slow * std::size(kWalked)), noises);
        }
    }
    for (std::size_t i = 0; two_parts && i < std::size(kTwoParts); ++i) {
        TrendKind kind{TrendShape::drift, false, 1, kTwoParts[i].kappa};
        kind.second_kappa = kTwoParts[i].second_kappa;
        kind.second_share = kTwoParts[i].second_share;
        add_family(kind, kTwo / double(std::size(kTwoParts)), noises);
    }
    for (std::size_t i = 0; swing && i < std::size(kFrequency); ++i) {
        for (const double rho : kSwinging) {
            TrendKind kind{TrendShape::drift, false, rho};
            kind.period = 1 / kFrequency[i];
            add_family(kind, kSwing / double(std::size(kSwinging) * std::size(kFrequency)),
                       noises_of_swings);
        }
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

void TrendModels::add_events() {
    const int q = increments_;
    // A frame is a mean over its unit, and a step within it shows half-way, whichever half.
    const bool halfway = q >= kFewestForRare;
    const double step = halfway ? prior_.event / 2 : prior_.event;
    for (int i = 0; i < q; ++i) {
        const int a = std::max(0, i - 1), b = std::min(a + 1, q - 1);
        const Vector2d which(i == a ? 1 : 0, i == a ? 0 : 1);
        events_.push_back({a, b, which.asDiagonal(), step, i + 1, false});
    }
    for (int i = 1; i < q; ++i) {
        const Matrix2d there_and_back{{1, -1}, {-1, 1}};
        events_.push_back({i - 1, i, there_and_back, prior_.event, i, true});
        if (halfway) events_.push_back({i - 1, i, Matrix2d::Identity(), step, i + 1, false});
    }
}

MatrixX2d TrendModels::touched(const Eigen::Ref<const MatrixXd>& matrix, const Event& event) {
    MatrixX2d out(matrix.rows(), 2);
    out << matrix.col(event.a), matrix.col(event.b);
    return out;
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
    m.level = -kind.eta * precision.row(increments_ - 1);
    m.unexplained =
        (moments.future - m.weights.cwiseProduct(moments.with_future).rowwise().sum()).cwiseMax(0);
    const auto first = Eigen::Index(at * variants()), of_variants = Eigen::Index(variants());
    m.shares.resize(3, of_variants - 1);
    Eigen::Index k = first, at_share = 0;
    const auto add_variant = [&](double determinant, double log_prior) {
        log_determinants_[k] = log_determinant + determinant;
        log_priors_[k++] = std::log(prior) + log_prior;
    };
    add_variant(0, 0);
    for (const Event& e : events_) {
        const double log_event = std::log(e.prior / double(std::size(kEventSize)));
        const Matrix2d here{{precision(e.a, e.a), precision(e.a, e.b)},
                            {precision(e.a, e.b), precision(e.b, e.b)}};
        for (const double tau : kEventSize) {
            // Woodbury's identity, of a covariance that may be singular.
            const Matrix2d covariance = tau * e.shape;
            const Matrix2d within = Matrix2d::Identity() + covariance * here;
            const Matrix2d share = within.inverse() * covariance;
            m.shares.col(at_share++) << share(0, 0), share(0, 1) + share(1, 0), share(1, 1);
            add_variant(std::log(within.determinant()), log_event);
        }
    }
    m.least_log_determinant = log_determinants_.segment(first, of_variants).minCoeff();
    m.most_log_prior = log_priors_.segment(first, of_variants).maxCoeff();
    models_.push_back(std::move(m));
}

MatrixXd TrendModels::seen(const MatrixXd& gram) const {
    MatrixXd out = MatrixXd::Zero(increments_, 2 * Eigen::Index(models_.size()));
    if (events_.empty()) return out;
    const MatrixXd with_gram = gram * precisions_;
    for (std::size_t m = 0; m < models_.size(); ++m) {
        const auto at = Eigen::Index(m) * increments_;
        const auto p = precisions_.middleCols(at, increments_);
        const auto pg = with_gram.middleCols(at, increments_);
        auto to = out.middleCols(2 * Eigen::Index(m), 2);
        for (Eigen::Index i = 0; i < increments_; ++i) {
            to(i, 0) = p.col(i).dot(pg.col(i));
            if (i > 0) to(i - 1, 1) = p.col(i - 1).dot(pg.col(i));
        }
    }
    return out;
}

TrendModels::Evidence TrendModels::evidence(Eigen::ArrayXd squares, double count) const {
    const double q = increments_;
    const auto of_variants = Eigen::Index(variants());
    const auto variants_of = [&](const auto& all, std::size_t model) {
        return all.segment(Eigen::Index(model) * of_variants, of_variants);
    };
    // Most models are out of the question, which one logarithm tells: no variant is likelier than
    // the best of each of its terms.
    VectorXd most(Eigen::Index(models_.size()));
    for (std::size_t i = 0; i < models_.size(); ++i) {
        const double least = std::max(variants_of(squares, i).minCoeff() / q, 1e-12);
        most[Eigen::Index(i)] =
            -0.5 * count * (q * std::log(least) + models_[i].least_log_determinant) +
            models_[i].most_log_prior;
    }
    Evidence out{std::move(squares), std::vector<bool>(models_.size(), false)};
    double best = -std::numeric_limits<double>::infinity();
    const auto work_out = [&](std::size_t i) {
        if (out.conceivable[i] || most[Eigen::Index(i)] < best - kOutOfTheQuestion) return;
        out.conceivable[i] = true;
        auto e = out.share.segment(Eigen::Index(i) * of_variants, of_variants);
        e = -0.5 * count * (q * (e / q).max(1e-12).log() + variants_of(log_determinants_, i)) +
            variants_of(log_priors_, i);
        best = std::max(best, e.maxCoeff());
    };
    Eigen::Index likeliest = 0;
    most.maxCoeff(&likeliest);
    work_out(std::size_t(likeliest));
    for (std::size_t i = 0; i < models_.size(); ++i) work_out(i);
    double total = 0;
    for (std::size_t i = 0; i < models_.size(); ++i) {
        if (!out.conceivable[i]) continue;
        auto here = out.share.segment(Eigen::Index(i) * of_variants, of_variants);
        if (here.maxCoeff() < best - kOutOfTheQuestion) {
            out.conceivable[i] = false;
            continue;
        }
        for (double& e : here) total += e = e < best - kOutOfTheQuestion ? 0 : std::exp(e - best);
    }
    for (std::size_t i = 0; i < models_.size(); ++i)
        if (out.conceivable[i])
            out.share.segment(Eigen::Index(i) * of_variants, of_variants) /= total;
    return out;
}

Trend TrendModels::trend(const MatrixXd& gram, double count) const {
    const double q = increments_, scale = std::max(gram.trace() / q, 1e-30);
    const MatrixXd g = gram / scale;  // no underflow, whatever the unit
    const std::size_t events = events_.size();
    // Of a model, and of it with each event at each size.
    const std::size_t sizes = std::size(kEventSize);
    const MatrixXd seen_by_models = seen(g);
    const auto seen_by_event = [&](std::size_t model, const Event& e) {
        const auto of = seen_by_models.middleCols(2 * Eigen::Index(model), 2);
        return Matrix2d{{of(e.a, 0), of(e.a, 1)}, {of(e.a, 1), of(e.b, 0)}};
    };
    VectorXd alone(Eigen::Index(models_.size()));
    Eigen::ArrayXd squares(log_priors_.size());
    for (std::size_t i = 0, k = 0; i < models_.size(); ++i) {
        const auto m = Eigen::Index(i);
        const double all = alone[m] = precision(i).cwiseProduct(g).sum();
        squares[Eigen::Index(k++)] = all;
        const double* share = models_[i].shares.data();
        for (std::size_t e = 0; e < events; ++e) {
            const Matrix2d by_event = seen_by_event(i, events_[e]);
            const double first = by_event(0, 0), both = by_event(0, 1), last = by_event(1, 1);
            for (std::size_t size = 0; size < sizes; ++size, share += 3)
                squares[Eigen::Index(k++)] =
                    all - (share[0] * first + share[1] * both + share[2] * last);
        }
    }
    const Evidence evidence = this->evidence(std::move(squares), count);

    // V is fitted to count q values: as of a t distribution, its uncertainty widens the error.
    const double freedom = std::max(count * q, 3.0);
    const double widened = freedom / (freedom - 2);
    const auto units = Eigen::Index(kTrendUnits.size());
    Trend out;
    out.weights = MatrixXd::Zero(units, increments_);
    out.level = Eigen::RowVectorXd::Zero(increments_);
    VectorXd square = VectorXd::Zero(units), left = VectorXd::Zero(units);
    std::vector<double> of_event(events, 0);
    for (std::size_t i = 0; i < models_.size(); ++i) {
        const Model& m = models_[i];
        const auto of_variants = Eigen::Index(variants());
        if (!evidence.conceivable[i]) continue;
        const auto here = evidence.share.segment(Eigen::Index(i) * of_variants, of_variants);
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
            const Matrix2d by_event = seen_by_event(i, events_[e]);
            for (std::size_t size = 0; size < sizes; ++size) {
                const double p = here[k++];
                if (p < kNegligible) continue;
                of_model += p;
                of_event[e] += p;
                const auto parts = m.shares.col(Eigen::Index(e * sizes + size));
                const Matrix2d share{{parts[0], parts[1] / 2}, {parts[1] / 2, parts[2]}};
                const MatrixX2d at = touched(precision(i), events_[e]);
                const MatrixX2d toward = touched(m.weights, events_[e]);
                const MatrixX2d taken = toward * share;
                const double rest = all - share.cwiseProduct(by_event).sum();
                out.weights -= p * taken * at.transpose();
                out.level -= p * touched(m.level, events_[e]) * share * at.transpose();
                square += p * (plain - 2 * taken.cwiseProduct(with_gram * at).rowwise().sum() +
                               taken.cwiseProduct(taken * by_event).rowwise().sum());
                left += p * rest / q * (m.unexplained + taken.cwiseProduct(toward).rowwise().sum());
                variance += p * rest / q;
            }
        }
        out.weights += of_model * m.weights;
        out.level += of_model * m.level;
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
