// SPDX-License-Identifier: MIT
// How fast the world lets copper corrode: the pace E(t) of a chamber or of open air.
#pragma once

#include <cstdint>
#include <vector>

namespace verdigris {

/// E(t) = max(0, 1 + noise(t) + diurnal * sin(2 pi (t / day + phase))). Time in units.
struct EnvironmentOptions {
    double noise = 0;  ///< standard deviation of the noise, [0, 2]; 0 in a chamber
    /// Correlation time in units, [0.01, 1e4]: the noise is an Ornstein-Uhlenbeck process
    /// [UhlenbeckOrnstein1930]. chosen: 5, a twentieth of a recording.
    double correlation = 5;
    double diurnal = 0;  ///< amplitude of the day, [0, 2]
    double day = 24;     ///< its length in units, [0.01, 1e6]
    double phase = 0;    ///< in days
    std::uint64_t seed = 0;

    static EnvironmentOptions chamber() { return {}; }
    /// chosen: noise 0.3, a day of 24 units that swings by 0.2.
    static EnvironmentOptions air(std::uint64_t seed);
};

/// One realization of the pace, known on [0, duration] as straight lines between nodes 0.1 units
/// apart, so that its integral is exact and does not depend on how a caller steps. Same options,
/// same bytes.
class Environment {
  public:
    /// duration in units, (0, 1e6]. Throws Error{usage} naming the option and the allowed range.
    Environment(const EnvironmentOptions& options, double duration);

    /// E at time t; before 0 and after the end its value there. >= 0.
    double at(double t) const;
    /// Integral of E over [from, to] in units, to >= from: the exposure of a step. Adds up over
    /// adjoining steps and is exactly to - from in a chamber, to rounding.
    double exposure(double from, double to) const;

    static constexpr double kNodeUnits = 0.1;

  private:
    double total(double t) const;  // integral over [0, t]

    std::vector<double> pace_, total_;  // at the nodes
};

}  // namespace verdigris
