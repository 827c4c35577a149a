// SPDX-License-Identifier: MIT
#include "verdigris/deliver/delivery.h"

#include <fmt/format.h>

#include <cmath>

#include "verdigris/error.h"
#include "verdigris/forecast/forecast_io.h"

namespace verdigris {

const char* const kUnitSentence =
    "Horizons are accelerated units: shares of the observed recording, counted from its last "
    "frame. A unit is not calendar time; no date follows from it.";

std::string units_text(double units) {
    return fmt::format("{:+g} {}", units, std::abs(units) == 1 ? "unit" : "units");
}

std::string writer_version() {
    return VERDIGRIS_VERSION;
}

std::vector<DeliveredState> delivered_states(const Delivery& delivery) {
    if (!delivery.forecast || !delivery.recipe) {
        throw Error(ErrorCode::usage, "a delivery needs a forecast and a material recipe");
    }
    std::vector<DeliveredState> states;
    states.push_back({0, horizon_label(0), "observed (last frame)"});
    double last = 0;
    for (double horizon : delivery.horizons) {
        if (!std::isfinite(horizon) || horizon <= last) {
            throw Error(ErrorCode::usage,
                        fmt::format("horizons must be positive and increasing, but {:g} follows "
                                    "{:g}",
                                    horizon, last));
        }
        last = horizon;
        states.push_back({horizon, horizon_label(horizon), units_text(horizon) + " (forecast)"});
    }
    return states;
}

double trusted_horizon(const Delivery& delivery) {
    if (delivery.horizons.empty()) return 0;
    // Twice the context: where the guard "long_horizon" starts [Paper, Section 8].
    const double limit = 2.0 * delivery.forecast->context_length;
    double best = delivery.horizons.front();
    for (double horizon : delivery.horizons) {
        if (horizon <= limit) best = horizon;
    }
    return best;
}

Origin origin_of(const std::vector<MapOrigin>& origins, const std::string& map) {
    for (const MapOrigin& origin : origins) {
        if (origin.map == map) return origin.origin;
    }
    return Origin::modeled;
}

}  // namespace verdigris
