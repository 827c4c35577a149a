// SPDX-License-Identifier: MIT
#include "verdigris/copper/environment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "verdigris/copper/in_range.h"

namespace verdigris {
namespace {

// The engine's numbers are fixed by the standard, its distributions are not: hence this one, after
// [BoxMuller1958].
class Gaussian {
  public:
    explicit Gaussian(std::uint64_t seed) : engine_(seed) {}
    double next() {
        const double u = unit(), v = unit();
        return std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * std::numbers::pi * v);
    }

  private:
    double unit() { return double(engine_() >> 11) * 0x1p-53; }  // [0, 1)
    std::mt19937_64 engine_;
};

}  // namespace

EnvironmentOptions EnvironmentOptions::air(std::uint64_t seed) {
    EnvironmentOptions options;
    options.noise = 0.3;
    options.diurnal = 0.2;
    options.seed = seed;
    return options;
}

Environment::Environment(const EnvironmentOptions& options, double duration) {
    demand_in_range(options.noise, 0, 2, "noise");
    demand_in_range(options.correlation, 0.01, 1e4, "correlation");
    demand_in_range(options.diurnal, 0, 2, "diurnal");
    demand_in_range(options.day, 0.01, 1e6, "day");
    demand_in_range(options.phase, -1e6, 1e6, "phase");
    demand_in_range(duration, 1e-9, 1e6, "duration");
    const std::size_t nodes = std::size_t(std::ceil(duration / kNodeUnits)) + 1;
    pace_.reserve(nodes);
    total_.reserve(nodes);
    // The exact step of the process, whatever its length: x <- e^{-h/T} x + sqrt(1 - e^{-2h/T}) n
    // [Gillespie1996]. It starts in its stationary state, so no time is warmer than another.
    const double keep = std::exp(-kNodeUnits / options.correlation);
    const double fresh = std::sqrt(-std::expm1(-2 * kNodeUnits / options.correlation));
    Gaussian gaussian(options.seed);
    double x = gaussian.next(), total = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
        const double days = double(i) * kNodeUnits / options.day + options.phase;
        const double pace = std::max(
            0.0, 1 + options.noise * x + options.diurnal * std::sin(2 * std::numbers::pi * days));
        if (i > 0) total += (pace + pace_.back()) / 2 * kNodeUnits;
        pace_.push_back(pace);
        total_.push_back(total);
        x = keep * x + fresh * gaussian.next();
    }
}

double Environment::at(double t) const {
    const double last = double(pace_.size() - 1);
    const double s = std::clamp(t / kNodeUnits, 0.0, last);
    const std::size_t i = std::min(std::size_t(s), pace_.size() - 2);
    return std::lerp(pace_[i], pace_[i + 1], s - double(i));
}

double Environment::total(double t) const {
    const double end = double(pace_.size() - 1) * kNodeUnits;
    if (t <= 0) return t * pace_.front();
    if (t >= end) return total_.back() + (t - end) * pace_.back();
    const std::size_t i = std::min(std::size_t(t / kNodeUnits), pace_.size() - 2);
    const double into = t - double(i) * kNodeUnits;
    return total_[i] + into * (pace_[i] + at(t)) / 2;
}

double Environment::exposure(double from, double to) const {
    return total(to) - total(from);
}

}  // namespace verdigris
