// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "verdigris/forecast/band_components.h"
#include "verdigris/forecast/band_spread.h"
#include "verdigris/forecast/context_pixels.h"

namespace verdigris {
namespace {

using Eigen::MatrixXd;

constexpr int kLongestContext = 40;
// chosen: from a fifth on it changes what a reader makes of the gain.
constexpr double kMuchOfIt = 0.2, kMostOfIt = 0.9;

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

/// The last of kTrendUnits until which those that count are confident to beat holding still; the
/// first at least, because that also takes the last frame's noise back.
int trusted_until(const std::vector<Component>& components, double confidence,
                  const std::function<bool(const Component&)>& counts) {
    const Eigen::VectorXd advantage = expected_advantage(components, counts);
    int last = -1;
    while (last + 1 < int(advantage.size()) && advantage[last + 1] >= confidence) ++last;
    return std::max(last, 0);
}

/// All is followed while all together is sure enough. Light that jitters is never sure, and what it
/// leaves may well be: light, and all but it, are each followed as long as they are by themselves.
void hold(std::vector<Component>& components, double confidence) {
    const int all = trusted_until(components, confidence, [](const Component&) { return true; });
    for (const bool light : {true, false}) {
        const int own = trusted_until(components, confidence,
                                      [light](const Component& c) { return c.light == light; });
        for (Component& c : components)
            if (c.light == light) c.held = std::max(all, own);
    }
}

/// All components as one trajectory of two terms, each held from where it is.
Trajectory joined(const Context& context, const std::vector<Component>& components, bool clamp) {
    const auto count = Eigen::Index(components.size()) * kTerms;
    const auto units = Eigen::Index(kTrendUnits.size());
    MatrixXd weights(units, count), gram = MatrixXd::Zero(count, count);
    for (std::size_t i = 0; i < components.size(); ++i) {
        const auto at = Eigen::Index(i) * kTerms;
        MatrixXd laws = components[i].laws;
        const Eigen::Index held = components[i].held;
        for (Eigen::Index u = held + 1; u < units; ++u) laws.row(u) = laws.row(held);
        weights.middleCols(at, kTerms) = laws;
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
    const int last = std::ranges::max(components, {}, &Component::held).held;
    for (Eigen::Index u = 0; u <= last; ++u)
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

/// What all forecasts of one forecaster have in common. For several threads at once.
struct Method {
    BandTrendDesign design;
    TrendModelsCache models{design.prior};
    // Light goes nowhere by itself: what is known of it is where it usually is.
    TrendModelsCache light_models{[this] {
        TrendPrior prior = design.prior;
        prior.drift = false;
        return prior;
    }()};
};

Forecast forecast(const Context& context, bool clamp, Method& method) {
    TrendModelsCache& models = method.models;
    const Mask moving = specimen_of(context);
    if (context.length() < 2)
        return held(context, "With 1 frame observed there is no change to carry on: held.");
    if (count_inside(moving) < 16)
        return held(context, "No usable pixel lies on the specimen, so the last state is held.");
    Components components =
        components_of(context, moving, method.design, models, method.light_models);
    if (components.all.empty())
        return held(context, "Nothing changed in the context, so the last state is held.");
    Forecast f;
    f.forecaster = "bandtrend";
    f.context_length = context.length();
    hold(components.all, method.design.confidence);
    f.trajectory = joined(context, components.all, clamp);
    f.spread = spread_of(moving, components);
    // What all of the specimen shares tells best.
    const auto event_of = [](const Component& c) { return c.common ? c.trend.event : 0; };
    const Trend& told = std::ranges::max_element(components.all, {}, event_of)->trend;
    if (told.event > 0.9) {
        f.explanation = told.outlier
                            ? fmt::format(
                                  "Frame {} of {} is unlike its neighbors and does not "
                                  "count. ",
                                  told.event_frame + 1, context.length())
                            : fmt::format("The step before frame {} of {} is not carried on. ",
                                          told.event_frame + 1, context.length());
    }
    return f;
}

/// From where on a trend is held, in a sentence; of one that never is, nothing.
std::string held_sentence(const TimeLaw& law) {
    const double last = law.nodes.back().horizon;
    if (last >= kTrendUnits.back()) return "";
    return fmt::format(
        " Beyond +{:.0f} the trend is held: further on it is not sure enough to beat holding "
        "still.",
        last);
}

double error_on(const Forecast& f, const Context& truth, int begin, int count, const Mask& moving) {
    double sum = 0;
    for (int i = 0; i < count; ++i)
        sum += mean_square_difference(f.at(i + 1), truth.frames[std::size_t(begin + i)], moving);
    return sum / count;
}

/// Where a forecast starts before any trend: the last frame without its noise, as far as told.
Image<SrgbF> level_of(const Forecast& f) {
    Image<SrgbF> level = f.at(1);
    const Image<SrgbF> next = f.at(2);
    for (std::size_t i = 0; i < level.pixels().size(); ++i) {
        SrgbF& c = level.pixels()[i];
        const SrgbF n = next.pixels()[i];
        c = {2 * c.r - n.r, 2 * c.g - n.g, 2 * c.b - n.b};
    }
    return level;
}

/// What the same method said of the end of the context when that was held back. Whoever reads of a
/// gain takes it for foresight, so what the frame held still had of noise is told apart.
std::string evidence(const Context& context, Method& method) {
    const int back = std::max(1, std::min(context.length() - 3, context.length() / 3));
    if (context.length() < 5) return "";
    const int seen = context.length() - back;
    const Context before = end_of(context, 0, seen);
    const Mask moving = specimen_of(context);
    const double still = error_on(persistence().forecast(before), context, seen, back, moving);
    const Forecast forecast_before = forecast(before, false, method);
    const double ours = error_on(forecast_before, context, seen, back, moving);
    if (!(still > 0)) return "";
    const double gain = 1 - ours / still;
    const std::string frames = back == 1 ? "frame was" : fmt::format("{} frames were", back);
    if (std::abs(gain) <= 0.005)
        return fmt::format("Held back, the last {} predicted as well as by holding still.", frames);
    std::string part;
    if (gain > 0 && forecast_before.trajectory.law.tabulated()) {
        const Image<SrgbF> level = level_of(forecast_before);
        double error = 0;
        for (int i = 0; i < back; ++i)
            error += mean_square_difference(level, context.frames[std::size_t(seen + i)], moving);
        const double share = (1 - error / back / still) / gain;
        if (share >= kMostOfIt)
            part = ", nearly all of it by taking back the noise of one frame";
        else if (share >= kMuchOfIt)
            part = fmt::format(", {:.0f} points of it by taking back the noise of one frame",
                               100 * share * gain);
    }
    return fmt::format("Held back, the last {} predicted {:.0f} % {} than by holding still{}.",
                       frames, 100 * std::abs(gain), gain > 0 ? "better" : "worse", part);
}

}  // namespace

Forecaster band_trend(const BandTrendOptions& options) {
    return {"bandtrend",
            [options, method = std::make_shared<Method>(options.design)](const Context& context) {
                check_context(context);
                const bool long_one = context.length() > kLongestContext;
                const Context recent =
                    long_one ? end_of(context, context.length() - kLongestContext, kLongestContext)
                             : Context();
                const Context& used = long_one ? recent : context;
                Forecast f = forecast(used, options.clamp, *method);
                if (options.explain && f.trajectory.law.tabulated())
                    f.explanation += evidence(used, *method) + held_sentence(f.trajectory.law);
                f.context_length = context.length();
                return f;
            }};
}

}  // namespace verdigris
