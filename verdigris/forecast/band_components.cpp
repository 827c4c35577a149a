// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_components.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/forecast/cautious_trend.h"
#include "verdigris/forecast/change_part.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Eigen::MatrixXd;

// chosen: what a pixel did is told from its neighborhood, so that it is not told from its noise.
constexpr int kEnergySigma = 2;

constexpr double kLightCount = 1;  // chosen: the channels share nearly all of it

/// Log of the light of each frame over that of the one before, from gains to the last one's.
Eigen::MatrixX3d log_steps(const LightGains& light) {
    Eigen::MatrixX3d steps(Eigen::Index(light.size()) - 1, 3);
    for (Eigen::Index i = 0; i < steps.rows(); ++i)
        for (int k = 0; k < 3; ++k)
            steps(i, k) = std::log(light[std::size_t(i)][std::size_t(k)]) -
                          std::log(light[std::size_t(i) + 1][std::size_t(k)]);
    return steps;
}

Component forecast_component(const ChangePart& part, const PartMoments& moments, double count,
                             const TrendModels& models, double caution = 0) {
    Component c;
    c.count = count;
    c.increments = moments.gram;
    if (!(c.increments.trace() > 0)) return c;
    c.trend = models.trend(c.increments, count);
    be_cautious(c.trend, c.increments, caution);
    const FewTerms few = few_terms(c.trend.weights, c.increments);
    c.laws = few.laws;
    c.gram = few.parts * c.increments * few.parts.transpose();
    for (int i = 0; i < kTerms; ++i) c.terms.push_back(part.combined(few.parts.row(i)));
    return c;
}

/// Error of a trend among models that it does not follow: light is not forecast to go on, and may.
Eigen::VectorXd error_if_it_goes_on(const Component& c, const TrendModels& models) {
    const Trend wide = models.trend(c.increments, c.count);
    const MatrixXd apart = wide.weights - c.trend.weights;
    return wide.error + (apart * c.increments).cwiseProduct(apart).rowwise().sum();
}

/// Mean square of the increments, per pixel and channel.
Image<SrgbF> energy_of(const Increments& d, const Mask& moving) {
    ColorField energy;
    const MaskedGaussian gaussian(moving, kEnergySigma);
    parallel_for(3, [&](int i) {
        const auto k = std::size_t(i);
        Field sum(d.front()[k].size(), 0);
        const float share = 1 / float(d.size());
        for (const ColorField& one : d)
            for (std::size_t at = 0; at < sum.size(); ++at)
                sum[at] += share * one[k][at] * one[k][at];
        gaussian.mean(sum, energy[k]);
    });
    Image<SrgbF> out(moving.width(), moving.height());
    for (std::size_t at = 0; at < out.pixels().size(); ++at)
        out.pixels()[at] = {energy[0][at], energy[1][at], energy[2][at]};
    return out;
}

}  // namespace

FewTerms few_terms(const MatrixXd& weights, const MatrixXd& gram) {
    const auto q = gram.rows();
    const double floor = 1e-12 * gram.trace() / double(q) + 1e-30;
    const MatrixXd half = Eigen::LLT<MatrixXd>(gram + floor * MatrixXd::Identity(q, q)).matrixL();
    const MatrixXd change = weights * half;
    const Eigen::VectorXd size = (change.rowwise().squaredNorm().array() + 1e-30).sqrt();
    const Eigen::JacobiSVD<MatrixXd> svd(size.cwiseInverse().asDiagonal() * change,
                                         Eigen::ComputeThinU | Eigen::ComputeThinV);
    FewTerms out{MatrixXd::Zero(weights.rows(), kTerms), MatrixXd::Zero(kTerms, weights.cols())};
    for (int i = 0; i < std::min<int>(kTerms, int(svd.singularValues().size())); ++i) {
        const double s = svd.singularValues()[i];
        if (!(s > 1e-9 * svd.singularValues()[0]) || !(s > 0)) break;
        out.laws.col(i) = size.asDiagonal() * svd.matrixU().col(i) * s;
        out.parts.row(i) =
            svd.matrixU().col(i).transpose() * size.cwiseInverse().asDiagonal() * weights / s;
    }
    return out;
}

const TrendModels& TrendModelsCache::of(int increments) {
    const std::lock_guard lock(mutex_);
    auto& slot = made_[increments];
    if (!slot) slot = std::make_unique<TrendModels>(increments, prior_);
    return *slot;
}

namespace {

/// One walk at random and a drift that walks are hardly told apart in what has few parts behind it.
TrendPrior without_walking(TrendPrior prior) {
    prior.walking = false;
    return prior;
}

/// Light goes nowhere by itself: what is known of it is where it usually is.
TrendPrior without_drift(TrendPrior prior) {
    prior.drift = false;
    return prior;
}

}  // namespace

BandModels::BandModels(const TrendPrior& prior)
    : own(prior), common(without_walking(prior)), light(without_drift(prior)) {}

Components components_of(const Context& context, const Mask& moving, const BandTrendDesign& design,
                         BandModels& models) {
    const LightGains light = design.light ? backdrop_light(context) : LightGains{};
    Increments rest = increments_of(context, moving, light);
    const int q = int(rest.size());
    const TrendModels &own = models.own.of(q), &common = models.common.of(q);
    const double area = double(count_inside(moving));
    Components out;
    const auto add_light = [&](Component made) {
        made.common = made.light = true;
        out.all.push_back(std::move(made));
    };
    const bool corrected = std::ranges::any_of(light, [](const auto& gain) {
        return gain != std::array<double, 3>{1, 1, 1};
    });
    if (corrected && design.relight) {
        // It was taken off the increments by relighting them; where it goes is another matter.
        const LightPart part(context, moving, log_steps(light));
        Component c = forecast_component(part, part.moments(), kLightCount, models.light.of(q));
        if (!c.terms.empty()) c.trend.error = error_if_it_goes_on(c, common);
        add_light(std::move(c));
    }
    if (design.light && design.gray && !shows_light(context)) {
        const LightPart part(context, moving, rest);
        add_light(
            forecast_component(part, part.moments(), design.global_count, common, design.caution));
        part.subtract(rest);
    }
    if (design.global) {
        const AffinePart part(context, moving, rest);
        const AffinePart mean = part.mean(), slopes = part.slopes();
        const auto add = [&](const AffinePart& one, const TrendModels& trends, double caution) {
            const PartMoments moments = one.moments();
            out.all.push_back(
                forecast_component(one, moments, design.global_count, trends, caution));
            return moments.energy;
        };
        // The color of all and its contrasts need not have the same future.
        out.global_energy = add(design.split ? mean : part, common, design.caution);
        out.all.back().common = true;
        if (design.split) add(slopes, own, 0);
        part.subtract(rest);
    }
    out.local_energy = energy_of(rest, moving);
    const std::vector<int> sigmas = design.local && design.bands
                                        ? band_sigmas(moving.width(), moving.height())
                                        : std::vector<int>();
    for (const int sigma : sigmas) {
        const SmoothPart part(rest, moving, sigma);
        const double cells = area / (4 * std::numbers::pi * sigma * sigma);
        out.all.push_back(forecast_component(part, part.moments(),
                                             std::clamp(cells, 1.0, design.largest_count), own));
        part.subtract(rest);
    }
    if (design.local) {
        const RestPart part(rest, moving);
        out.all.push_back(forecast_component(part, part.moments(), design.largest_count, own));
    }
    std::erase_if(out.all, [](const Component& c) { return c.terms.empty(); });
    return out;
}

}  // namespace verdigris
