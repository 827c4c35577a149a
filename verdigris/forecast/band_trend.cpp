// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "verdigris/forecast/band_components.h"
#include "verdigris/forecast/band_method.h"
#include "verdigris/forecast/band_spread.h"
#include "verdigris/forecast/context_pixels.h"

namespace verdigris {
namespace {

using Eigen::MatrixXd;

// chosen: from a fifth on it changes what a reader makes of the gain.
constexpr double kMuchOfIt = 0.2, kMostOfIt = 0.9;

Forecast held(const Context& context, std::string why) {
    Forecast f = persistence().forecast(context);
    f.forecaster = "bandtrend";
    f.explanation = std::move(why);
    return f;
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

Forecast forecast(const Context& context, bool clamp, BandMethod& method) {
    const Mask moving = specimen_of(context);
    if (context.length() < 2)
        return held(context, "With 1 frame observed there is no change to carry on: held.");
    if (count_inside(moving) < 16)
        return held(context, "No usable pixel lies on the specimen, so the last state is held.");
    const Components components = held_components(context, moving, method);
    if (components.all.empty())
        return held(context, "Nothing changed in the context, so the last state is held.");
    Forecast f;
    f.forecaster = "bandtrend";
    f.context_length = context.length();
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
std::string evidence(const Context& context, BandMethod& method) {
    const int back = std::max(1, std::min(context.length() - 3, context.length() / 3));
    if (context.length() < 5) return "";
    const int seen = context.length() - back;
    const Context before = part_of(context, 0, seen);
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
    return {"bandtrend", [options, method = std::make_shared<BandMethod>(options.design)](
                             const Context& context) {
                check_context(context);
                const bool long_one = context.length() > kLongestContext;
                const Context recent =
                    long_one ? part_of(context, context.length() - kLongestContext, kLongestContext)
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
