// SPDX-License-Identifier: MIT
#include "verdigris/forecast/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "verdigris/error.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/observe/noise.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

/// Kept samples between two unit steps: samples_per_unit if all were kept, 1 if only the steps.
int steps_between(const Observation& observation) {
    const auto& samples = observation.samples;
    const UnitAxis& axis = observation.axis;
    if (samples.size() < 2 || axis.samples < 1) return 1;
    const double kept = (samples.back().unit - samples.front().unit) / double(samples.size() - 1);
    const double step = axis.units / axis.samples * std::max(axis.samples_per_unit, 1);
    return kept > 0 ? std::max(1, int(std::lround(step / kept))) : 1;
}

Image<SrgbF> blend(const Image<SrgbF>& a, const Image<SrgbF>& b, double share) {
    Image<SrgbF> out = Image<SrgbF>::for_overwrite(a.width(), a.height());
    const float t = float(share);
    std::transform(
        a.pixels().begin(), a.pixels().end(), b.pixels().begin(), out.pixels().begin(),
        [t](SrgbF p, SrgbF q) {
            return SrgbF{p.r + t * (q.r - p.r), p.g + t * (q.g - p.g), p.b + t * (q.b - p.b)};
        });
    return out;
}

Image<SrgbF> read_stack(const FrameStack& stack, double horizon) {
    if (!(horizon >= 0)) throw Error(ErrorCode::usage, "a horizon must be 0 or more");
    if (horizon > stack.horizons.back()) {
        throw Error(ErrorCode::usage,
                    fmt::format("this forecaster gives frames up to horizon {}; {} was asked",
                                stack.horizons.back(), horizon));
    }
    if (horizon == 0) return stack.base.clone();
    const auto next = std::lower_bound(stack.horizons.begin(), stack.horizons.end(), horizon);
    const auto i = std::size_t(std::distance(stack.horizons.begin(), next));
    if (*next == horizon) return stack.frames[i].clone();
    const double before = i == 0 ? 0 : stack.horizons[i - 1];
    const Image<SrgbF>& from = i == 0 ? stack.base : stack.frames[i - 1];
    return blend(from, stack.frames[i], (horizon - before) / (*next - before));
}

}  // namespace

namespace {

/// Observation::clipped speaks of the whole recording; a pixel whose glint is over before the
/// context begins is as good as any. Here: clipped, or next to clipped, in some context frame.
Mask clipped_in(const std::vector<Image<SrgbF>>& frames) {
    Mask left(frames[0].width(), frames[0].height());
    parallel_rows(left.height(), 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < left.width(); ++x) {
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, left.height() - 1); ++v) {
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, left.width() - 1); ++u) {
                        for (const Image<SrgbF>& frame : frames) {
                            if (is_clipped(frame(u, v))) left(x, y) = kInside;
                        }
                    }
                }
            }
        }
    });
    return left;
}

}  // namespace

Mask backdrop_of(const Observation& observation) {
    if (observation.specimen.empty()) return {};
    Mask backdrop = observation.specimen.clone();
    for (std::uint8_t& v : backdrop.pixels()) v = v ? 0 : kInside;
    return backdrop;
}

Context context_from(const Observation& observation, int length) {
    if (length < 1) throw Error(ErrorCode::usage, "a context has at least one frame");
    if (!observation.store || observation.store->count() < 1) {
        throw Error(ErrorCode::bad_input, "the observation holds no sample",
                    observation.source_name);
    }
    const int stride = steps_between(observation);
    const int last = observation.store->count() - 1;
    const int available = last / stride + 1;
    Context context;
    for (int back = std::min(length, available) - 1; back >= 0; --back) {
        context.frames.push_back(observation.store->image(last - back * stride));
    }
    context.specimen = observation.specimen.clone();
    context.clipped = clipped_in(context.frames);
    context.sigma = observation.noise.sigma;
    context.tau = observation.noise.tau;
    check_context(context);
    return context;
}

Image<SrgbF> Forecast::at(double horizon) const {
    if (!is_trajectory()) return read_stack(stack, horizon);
    Image<SrgbF> out;
    evaluate_trajectory(trajectory, horizon, out);
    return out;
}

Forecaster persistence() {
    return {"persistence", [](const Context& context) {
                check_context(context);
                const Image<SrgbF>& last = context.frames.back();
                Forecast forecast;
                forecast.forecaster = "persistence";
                forecast.explanation = "The last observed state is held: nothing is forecast.";
                forecast.trajectory.base = last.clone();
                forecast.trajectory.rate = Image<SrgbF>(last.width(), last.height());
                forecast.trajectory.law = {0, context.length()};
                forecast.context_length = context.length();
                return forecast;
            }};
}

}  // namespace verdigris
