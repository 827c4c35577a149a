// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/peeking.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/evaluate/windows.h"

namespace verdigris {
namespace {

Context context_at(const EvaluationProtocol& protocol, const Observation& observation,
                   const std::vector<int>& kept) {
    Context context;
    for (const int s : kept) context.frames.push_back(observation.store->image(s));
    if (protocol.area == EvaluatedArea::specimen) context.specimen = observation.specimen.clone();
    context.backdrop = backdrop_of(observation);
    context.sigma = observation.noise.sigma;
    context.tau = protocol.tau.value_or(observation.noise.tau);
    return context;
}

std::vector<Image<SrgbF>> frames_of(const Forecast& forecast, int horizons) {
    std::vector<Image<SrgbF>> frames;
    for (int k = 1; k <= horizons; ++k) frames.push_back(forecast.at(k));
    return frames;
}

bool same_bytes(const std::vector<Image<SrgbF>>& a, const std::vector<Image<SrgbF>>& b) {
    return std::ranges::equal(a, b, [](const Image<SrgbF>& p, const Image<SrgbF>& q) {
        return p.same_size(q) && std::memcmp(p.row(0), q.row(0), p.byte_count()) == 0;
    });
}

}  // namespace

ScrambledSamples::ScrambledSamples(std::shared_ptr<const SampleStore> samples)
    : samples_(std::move(samples)) {
    if (!samples_) throw Error(ErrorCode::usage, "there are no samples to scramble");
}

void ScrambledSamples::keep_only(std::optional<std::vector<int>> kept) {
    const std::lock_guard lock(mutex_);
    kept_ = std::move(kept);
}

Image<SrgbF> ScrambledSamples::image(int index) const {
    Image<SrgbF> image = samples_->image(index);
    {
        const std::lock_guard lock(mutex_);
        if (!kept_ || std::ranges::find(*kept_, index) != kept_->end()) return image;
    }
    std::ranges::reverse(image.pixels());
    for (SrgbF& c : image.pixels()) c = {1 - c.r, 1 - c.g, 1 - c.b};
    return image;
}

Statuses check_peeking(const EvaluationProtocol& protocol, const Observation& observation,
                       ScrambledSamples& samples, const Forecaster& forecaster,
                       std::span<const int> starts) {
    check_protocol(protocol);
    if (observation.store.get() != &samples) {
        throw Error(ErrorCode::usage, "the observation does not read the samples to be scrambled");
    }
    Statuses findings;
    for (const int start : starts) {
        std::vector<int> kept = window_samples(protocol, start);
        kept.resize(std::size_t(protocol.context));
        const Context context = context_at(protocol, observation, kept);
        const auto forecast = [&] {
            return frames_of(forecaster.forecast(context), protocol.horizons);
        };
        const auto before = forecast();
        if (!same_bytes(before, forecast())) {
            findings.push_back(
                {"forecast_not_repeatable", Severity::refusal,
                 fmt::format("{} forecasts the same context differently each time: where it looks "
                             "cannot be told",
                             forecaster.name)});
            break;
        }
        samples.keep_only(kept);
        const bool same = same_bytes(before, forecast());
        samples.keep_only(std::nullopt);
        if (same) continue;
        findings.push_back(
            {"looks_beyond_context", Severity::refusal,
             fmt::format("{} forecasts the window from sample {} differently when the samples "
                         "outside of its context are replaced: it reads them",
                         forecaster.name, start)});
        break;
    }
    return findings;
}

}  // namespace verdigris
