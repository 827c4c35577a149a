// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/learn/learn.h"
#include "verdigris/learn/network_parts.h"
#include "verdigris/learn/tensor_image.h"

namespace verdigris {
namespace {

Forecast forecast_with(const Network& network, const std::string& name,
                       const std::vector<int>& units, const Context& context) {
    const NetworkConfig& config = network.config();
    if (context.length() != config.context) {
        throw Error(ErrorCode::usage,
                    fmt::format("{} was trained on contexts of {} frames and is given {}", name,
                                config.context, context.length()));
    }
    const Image<SrgbF>& last = context.frames.back();
    std::vector<torch::Tensor> frames;
    for (const Image<SrgbF>& frame : context.frames) frames.push_back(tensor_of(frame));

    Forecast forecast;
    forecast.forecaster = name;
    forecast.context_length = context.length();
    forecast.stack.base = last.clone();
    forecast.stack.horizons.assign(units.begin(), units.end());

    const torch::Tensor forecasts =
        forecast_frames(network, torch::stack(frames).unsqueeze(0), units)[0];
    for (std::size_t k = 0; k < units.size(); ++k)
        forecast.stack.frames.push_back(image_of(forecasts[std::int64_t(k)]));
    forecast.explanation = fmt::format(
        "{}, a trained network ({} parameters), continues what it was trained on{}", name,
        network.parameter_count(),
        last.same_size(config.size, config.size)
            ? ""
            : fmt::format("; it sees {} x {} pixels, and the change it forecasts is enlarged",
                          config.size, config.size));
    return forecast;
}

}  // namespace

torch::Tensor forecast_frames(const Network& network, const torch::Tensor& contexts,
                              const std::vector<int>& units) {
    Network::Parts& parts = network.parts();
    const std::lock_guard lock(parts.one_at_a_time);
    const torch::NoGradGuard frozen;
    const int size = parts.config.size;
    const std::int64_t n = contexts.size(1), height = contexts.size(3), width = contexts.size(4);
    if (height == size && width == size)
        return parts.module->predict(contexts.to(parts.device), units).to(torch::kCPU);
    const torch::Tensor seen = resized(contexts.flatten(0, 1), size, size)
                                   .view({contexts.size(0), n, 3, size, size})
                                   .to(parts.device);
    const torch::Tensor change =
        (parts.module->predict(seen, units) - seen.narrow(1, n - 1, 1)).to(torch::kCPU);
    return contexts.narrow(1, n - 1, 1) +
           resized(change.flatten(0, 1), int(width), int(height))
               .view({contexts.size(0), change.size(1), 3, height, width});
}

Forecaster as_forecaster(std::shared_ptr<const Network> network, std::string name,
                         std::vector<int> horizons) {
    int last = 0;
    for (const int unit : horizons) {
        if (unit <= last || unit > 1000) {
            throw Error(ErrorCode::usage,
                        fmt::format("a network's horizons are whole units from 1 to 1000, in "
                                    "order; {} comes after {}",
                                    unit, last));
        }
        last = unit;
    }
    if (horizons.empty()) throw Error(ErrorCode::usage, "a network needs a horizon to forecast");
    Forecaster forecaster;
    forecaster.name = name;
    forecaster.forecast = [network = std::move(network), name = std::move(name),
                           horizons = std::move(horizons)](const Context& context) {
        return forecast_with(*network, name, horizons, context);
    };
    return forecaster;
}

std::vector<int> units_to(int last) {
    std::vector<int> units(static_cast<std::size_t>(last));
    std::iota(units.begin(), units.end(), 1);
    return units;
}

}  // namespace verdigris
