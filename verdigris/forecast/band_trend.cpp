// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_trend.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>

#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/increments.h"
#include "verdigris/forecast/trend_models.h"

namespace verdigris {
namespace {

using Eigen::MatrixXd;

// chosen; docs/models/bandtrend.md has the sensitivity to both.
constexpr double kGlobalCount = 2;     // a global drift has few independent parts: light, and color
constexpr double kLargestCount = 100;  // neighbors are never as independent as they look
constexpr int kLongestContext = 40;
constexpr int kTerms = 2;  // of a trajectory

/// A product of few laws over kTrendUnits with as many combinations of what `weights` combines.
struct FewTerms {
    MatrixXd laws;   ///< [units x terms]
    MatrixXd parts;  ///< [terms x columns of weights]
};
/// The closest in squared change, each horizon relative to its own size. `gram`: of what `weights`
/// combines.
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

/// What is known of one component once its increments are forgotten.
struct Component {
    MatrixXd laws;                  ///< [units x terms]
    MatrixXd gram;                  ///< of its terms' images
    std::vector<ColorField> terms;  ///< three planes each
    Trend trend;
    double change = 0;  ///< mean square of its increments
};

Component forecast_component(const Increments& d, double count, const TrendModels& models) {
    Component c;
    const MatrixXd gram = gram_of(d);
    c.change = gram.trace() / double(gram.rows());
    if (!(c.change > 0)) return c;
    c.trend = models.trend(gram, count);
    const FewTerms few = few_terms(c.trend.weights, gram);
    c.laws = few.laws;
    c.gram = few.parts * gram * few.parts.transpose();
    for (int i = 0; i < kTerms; ++i) c.terms.push_back(combined(d, few.parts.row(i)));
    return c;
}

class Models {
  public:
    const TrendModels& of(int increments) {
        const std::lock_guard lock(mutex_);
        auto& slot = made_[increments];
        if (!slot) slot = std::make_unique<TrendModels>(increments);
        return *slot;
    }

  private:
    std::mutex mutex_;
    std::map<int, std::unique_ptr<TrendModels>> made_;
};

std::vector<Component> components_of(const Context& context, const Mask& moving, Models& models) {
    Increments rest = increments_of(context, moving);
    const TrendModels& trends = models.of(int(rest.size()));
    const double area = double(count_inside(moving));
    std::vector<Component> all;
    Increments part = affine_part(context, moving, rest);
    subtract(part, rest);
    all.push_back(forecast_component(part, kGlobalCount, trends));
    for (const int sigma : band_sigmas(moving.width(), moving.height())) {
        smooth_part(rest, moving, sigma, part);
        subtract(part, rest);
        const double cells = area / (4 * std::numbers::pi * sigma * sigma);
        all.push_back(forecast_component(part, std::clamp(cells, 1.0, kLargestCount), trends));
    }
    all.push_back(forecast_component(rest, kLargestCount, trends));
    std::erase_if(all, [](const Component& c) { return c.terms.empty(); });
    return all;
}

/// What may move; the backdrop is held where it is known, whatever else is to be forecast.
Mask specimen_of(const Context& context) {
    Mask mask = moving_mask(context);
    const auto backdrop = context.backdrop.pixels();
    for (std::size_t i = 0; i < backdrop.size(); ++i)
        if (backdrop[i] != 0) mask.pixels()[i] = 0;
    return mask;
}

Forecast held(const Context& context, std::string why) {
    Forecast f = persistence().forecast(context);
    f.forecaster = "bandtrend";
    f.explanation = std::move(why);
    return f;
}

/// All components as one trajectory of two terms.
Trajectory joined(const Context& context, const std::vector<Component>& components, bool clamp) {
    const auto count = Eigen::Index(components.size()) * kTerms;
    const auto units = Eigen::Index(kTrendUnits.size());
    MatrixXd weights(units, count), gram = MatrixXd::Zero(count, count);
    for (std::size_t i = 0; i < components.size(); ++i) {
        const auto at = Eigen::Index(i) * kTerms;
        weights.middleCols(at, kTerms) = components[i].laws;
        gram.block(at, at, kTerms, kTerms) = components[i].gram;
    }
    const FewTerms few = few_terms(weights, gram);
    std::vector<const ColorField*> images;
    for (const Component& c : components)
        for (const ColorField& p : c.terms) images.push_back(&p);
    Trajectory t;
    t.base = context.frames.back().clone();
    t.rate = image_of(images, few.parts.row(0), t.base);
    t.curvature = image_of(images, few.parts.row(1), t.base);
    t.law.order = 2;
    t.law.context = context.length();
    t.clamp = clamp;
    for (Eigen::Index u = 0; u < units; ++u)
        t.law.nodes.push_back({kTrendUnits[std::size_t(u)], few.laws(u, 0), few.laws(u, 1)});
    return t;
}

Context end_of(const Context& context, int begin, int count) {
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

Forecast forecast(const Context& context, bool clamp, Models& models) {
    const Mask moving = specimen_of(context);
    if (context.length() < 2)
        return held(context, "With 1 frame observed there is no change to carry on: held.");
    if (count_inside(moving) < 16)
        return held(context, "No usable pixel lies on the specimen, so the last state is held.");
    const std::vector<Component> components = components_of(context, moving, models);
    if (components.empty())
        return held(context, "Nothing changed in the context, so the last state is held.");
    Forecast f;
    f.forecaster = "bandtrend";
    f.context_length = context.length();
    f.trajectory = joined(context, components, clamp);
    const auto& global = components.front();
    if (global.trend.event > 0.9) {
        f.explanation =
            global.trend.outlier
                ? fmt::format("Frame {} of {} is unlike its neighbors and does not count. ",
                              global.trend.event_frame + 1, context.length())
                : fmt::format("The step before frame {} of {} is not carried on. ",
                              global.trend.event_frame + 1, context.length());
    }
    return f;
}

double error_on(const Forecast& f, const Context& truth, int begin, int count, const Mask& moving) {
    double sum = 0;
    for (int i = 0; i < count; ++i)
        sum += mean_square_difference(f.at(i + 1), truth.frames[std::size_t(begin + i)], moving);
    return sum / count;
}

/// What the same method said of the end of the context when that was held back.
std::string evidence(const Context& context, Models& models) {
    const int back = std::max(1, std::min(context.length() - 3, context.length() / 3));
    if (context.length() < 5) return "";
    const int seen = context.length() - back;
    const Context before = end_of(context, 0, seen);
    const Mask moving = specimen_of(context);
    const double still = error_on(persistence().forecast(before), context, seen, back, moving);
    const double ours = error_on(forecast(before, false, models), context, seen, back, moving);
    if (!(still > 0)) return "";
    const double gain = 1 - ours / still;
    const std::string frames = back == 1 ? "frame" : fmt::format("{} frames", back);
    if (gain > 0.005)
        return fmt::format(
            "Held back, the last {} were predicted {:.0f} % better than by holding "
            "still.",
            frames, 100 * gain);
    if (gain < -0.005)
        return fmt::format(
            "Held back, the last {} were predicted {:.0f} % worse than by holding "
            "still.",
            frames, -100 * gain);
    return fmt::format("Held back, the last {} were predicted as well as by holding still.",
                       frames);
}

}  // namespace

Forecaster band_trend(const BandTrendOptions& options) {
    return {"bandtrend", [options, models = std::make_shared<Models>()](const Context& context) {
                check_context(context);
                const bool long_one = context.length() > kLongestContext;
                const Context recent =
                    long_one ? end_of(context, context.length() - kLongestContext, kLongestContext)
                             : Context();
                const Context& used = long_one ? recent : context;
                Forecast f = forecast(used, options.clamp, *models);
                if (options.explain && f.trajectory.law.order > 0)
                    f.explanation += evidence(used, *models);
                f.context_length = context.length();
                return f;
            }};
}

}  // namespace verdigris
