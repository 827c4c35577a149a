// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/window_scorer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/evaluate/coverage.h"
#include "verdigris/evaluate/masked_error.h"

namespace verdigris {
namespace {

bool outside(SrgbF c, float slack) {
    const auto out = [slack](float v) { return !(v >= -slack && v <= 1 + slack); };
    return out(c.r) || out(c.g) || out(c.b);
}

double share_outside(const Image<SrgbF>& frame, const PixelWeights& area, double slack) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < frame.pixel_count(); ++i) {
        count += area.weight[i] != 0 && outside(frame.pixels()[i], float(slack));
    }
    return area.count > 0 ? double(count) / double(area.count) : 0;
}

/// Forecasts the last frame at every horizon, as order 0 of any family does.
bool holds(const Forecast& forecast, const Context& context) {
    const Trajectory& t = forecast.trajectory;
    const Image<SrgbF>& last = context.frames.back();
    return forecast.is_trajectory() && t.law.order == 0 && !forecast.spread.known() &&
           t.base.same_size(last) &&
           std::memcmp(t.base.row(0), last.row(0), last.byte_count()) == 0;
}

void copy_row(const EntrantScores& from, int row, EntrantScores& to) {
    const auto copy = [row](const ErrorTable& a, ErrorTable& b) {
        for (int k = 0; !a.empty() && k < a.horizons; ++k) b.at(row, k) = a.at(row, k);
    };
    copy(from.foreground, to.foreground);
    copy(from.specimen, to.specimen);
    copy(from.absolute, to.absolute);
    copy(from.delta_e, to.delta_e);
    for (std::size_t c = 0; c < 3; ++c) copy(from.bias[c], to.bias[c]);
    copy(from.outside, to.outside);
    copy(from.outside_by_a_step, to.outside_by_a_step);
}

/// Frame at horizon h: in place where the forecast already holds it, else made in `made`.
const Image<SrgbF>& frame_of(const Forecast& forecast, double h, Image<SrgbF>& made) {
    if (forecast.is_trajectory()) {
        if (forecast.trajectory.law.order == 0) return forecast.trajectory.base;
        evaluate_trajectory(forecast.trajectory, h, made);
        return made;
    }
    const auto& horizons = forecast.stack.horizons;
    const auto at = std::ranges::find(horizons, h);
    if (at != horizons.end()) return forecast.stack.frames[std::size_t(at - horizons.begin())];
    made = forecast.at(h);
    return made;
}

}  // namespace

WindowScratch ScratchPool::take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return {};
    WindowScratch scratch = std::move(free_.back());
    free_.pop_back();
    return scratch;
}

void ScratchPool::give(WindowScratch scratch) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(scratch));
}

WindowScorer::WindowScorer(const EvaluationProtocol& protocol, const Observation& observation,
                           const HeldRecording& held, double tau)
    : protocol_(protocol), observation_(observation), held_(held), tau_(tau) {
    const int width = held.width(), height = held.height();
    specimen_ = weights_of(observation.specimen, width, height);
    if (protocol.area == EvaluatedArea::specimen) area_mask_ = observation.specimen.clone();
    area_ = weights_of(area_mask_, width, height);
    for (std::size_t i = 0; i < specimen_.weight.size(); ++i) {
        if (specimen_.weight[i] != 0) specimen_indices_.push_back(std::uint32_t(i));
    }
}

const Image<SrgbF>& WindowScorer::truth(int start, int k) const {
    return held_.frame(start + (protocol_.context + k) * protocol_.stride);
}

void WindowScorer::context_of(int start, WindowScratch& scratch) const {
    Context& context = scratch.context;
    context.frames.resize(std::size_t(protocol_.context));
    const std::vector<int> samples = window_samples(protocol_, start);
    for (std::size_t i = 0; i < context.frames.size(); ++i) {
        const Image<SrgbF>& frame = held_.frame(samples[i]);
        if (!context.frames[i].same_size(frame)) {
            context.frames[i] = frame.clone();
        } else {
            std::ranges::copy(frame.pixels(), context.frames[i].pixels().begin());
        }
    }
    if (!context.specimen.same_size(area_mask_)) context.specimen = area_mask_.clone();
    if (!context.backdrop.same_size(observation_.specimen))
        context.backdrop = backdrop_of(observation_);
    held_.clipped(samples, protocol_.context, context.clipped);
    context.sigma = observation_.noise.sigma;
    context.tau = tau_;
}

std::int64_t WindowScorer::score(int start, int row, const std::vector<Forecaster>& forecasters,
                                 std::vector<EntrantScores>& scores, WindowScratch& scratch) const {
    context_of(start, scratch);
    std::vector<const Image<SrgbF>*> truths;
    for (int k = 0; k < protocol_.horizons; ++k) truths.push_back(&truth(start, k));
    canvas_of(scratch.context.frames, scratch.canvas, scratch.sort);
    foreground_of(truths, scratch.canvas, tau_, protocol_.mask, area_, scratch.foreground);
    const std::int64_t least =
        std::ranges::min_element(scratch.foreground, {}, &PixelWeights::count)->count;
    if (least < protocol_.min_foreground) return least;

    if (protocol_.delta_e) {
        scratch.truth_lab.resize(truths.size());
        for (std::size_t k = 0; k < truths.size(); ++k) {
            lab_of_pixels(*truths[k], specimen_indices_, scratch.truth_lab[k]);
        }
    }
    scratch.forecasts.clear();
    for (std::size_t i = 0; i < forecasters.size(); ++i) {
        Forecast forecast = forecasters[i].forecast(scratch.context);
        if (i > 0 && holds(forecast, scratch.context)) {
            copy_row(scores.front(), row, scores[i]);  // persistence again, to the bit
        } else {
            score_one(forecast, start, row, scores[i], scratch);
        }
        if (scratch.keep_forecasts) scratch.forecasts.push_back(std::move(forecast));
    }
    return least;
}

void WindowScorer::score_one(const Forecast& forecast, int start, int row, EntrantScores& scores,
                             WindowScratch& scratch) const {
    const Image<SrgbF>* converted = nullptr;  // whose Lab scratch.lab holds
    for (int k = 0; k < protocol_.horizons; ++k) {
        const double h = k + 1;
        const Image<SrgbF>& frame = frame_of(forecast, h, scratch.prediction);
        const Image<SrgbF>& real = truth(start, k);
        if (!frame.same_size(real)) {
            throw Error(ErrorCode::failed,
                        fmt::format("{} forecast a frame of {} x {} where the recording has {} x "
                                    "{}",
                                    scores.name, frame.width(), frame.height(), real.width(),
                                    real.height()));
        }
        const std::size_t mask = scratch.foreground.size() == 1 ? 0 : std::size_t(k);
        const MaskedError e = masked_error(frame, real, scratch.foreground[mask], specimen_);
        if (!std::isfinite(e.foreground) || !std::isfinite(e.specimen)) {
            throw Error(ErrorCode::failed,
                        fmt::format("{} forecast numbers that are not finite, {} units after "
                                    "sample {}",
                                    scores.name, k + 1,
                                    start + (protocol_.context - 1) * protocol_.stride));
        }
        scores.foreground.at(row, k) = e.foreground;
        scores.specimen.at(row, k) = e.specimen;
        scores.absolute.at(row, k) = e.absolute;
        for (std::size_t c = 0; c < 3; ++c) scores.bias[c].at(row, k) = e.bias[c];
        if (protocol_.delta_e) {
            const bool reuse = converted == &frame && converted != &scratch.prediction;
            if (!reuse) lab_of_pixels(frame, specimen_indices_, scratch.lab);
            converted = &frame;
            scores.delta_e.at(row, k) =
                mean_delta_e2000(scratch.lab, scratch.truth_lab[std::size_t(k)]);
        }
        const Coverage c = coverage_of(forecast.spread, h, frame, real, specimen_, scratch.spread);
        scores.pixels80.at(row, k) = c.pixels80;
        scores.pixels95.at(row, k) = c.pixels95;
        scores.mean80.at(row, k) = c.mean80;
        scores.mean95.at(row, k) = c.mean95;
        if (!protocol_.out_of_gamut) continue;
        const auto share = [&](double slack) {
            return forecast.is_trajectory()
                       ? out_of_gamut_share(forecast.trajectory, h, area_mask_, slack)
                       : share_outside(frame, area_, slack);
        };
        scores.outside.at(row, k) = share(0);
        scores.outside_by_a_step.at(row, k) = share(1.0 / 255);
    }
}

}  // namespace verdigris
