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

    Network::Parts& parts = network.parts();
    const std::lock_guard lock(parts.one_at_a_time);
    const torch::InferenceMode inference;
    const bool native = last.same_size(config.size, config.size);
    const torch::Tensor whole = torch::stack(frames);
    const torch::Tensor seen = resized(whole, config.size, config.size).to(parts.device);
    torch::Tensor forecasts = parts.module->predict(seen.unsqueeze(0), units)[0].to(torch::kCPU);
    if (!native) {
        const torch::Tensor change = forecasts - seen.narrow(0, context.length() - 1, 1).cpu();
        forecasts =
            whole.narrow(0, context.length() - 1, 1) + resized(change, last.width(), last.height());
    }
    for (std::size_t k = 0; k < units.size(); ++k)
        forecast.stack.frames.push_back(image_of(forecasts[std::int64_t(k)]));
    forecast.explanation = fmt::format(
        "{}, a trained network ({} parameters), continues what it was trained on{}", name,
        network.parameter_count(),
        native ? ""
               : fmt::format("; it sees {} x {} pixels, and the change it forecasts is enlarged",
                             config.size, config.size));
    return forecast;
}

}  // namespace

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
