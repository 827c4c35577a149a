// SPDX-License-Identifier: MIT
// Random numbers that are a pure function of what they are for: (seed, stream, index). So they do
// not depend on the order of computation, on the number of threads or on the standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace verdigris {

/// What a number is for; two uses never share a stream.
enum class RandomStream : std::uint64_t {
    susceptibility = 1,
    fine_susceptibility,
    drip,
    reaction,
    nuclei,
    wetness,
    texture,
    environment,
    light,
    white_balance,
    jitter,
    flicker,
    noise_tile,
    noise_offset,
};

/// The finalizer of SplitMix64 [Steele2014].
constexpr std::uint64_t mixed(std::uint64_t h) {
    h += 0x9E3779B97F4A7C15u;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9u;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBu;
    return h ^ (h >> 31);
}

class Random {
  public:
    Random(std::uint64_t seed, RandomStream stream)
        : key_(mixed(mixed(seed) ^ std::uint64_t(stream) * 0xD1342543DE82EF95u)) {}

    std::uint64_t bits(std::uint64_t index) const { return mixed(key_ ^ mixed(index)); }
    /// Uniform in [0, 1), 53 bits.
    double uniform(std::uint64_t index) const { return double(bits(index) >> 11) * 0x1p-53; }
    /// Standard normal [BoxMuller1958].
    double gaussian(std::uint64_t index) const {
        const double u = uniform(2 * index), v = uniform(2 * index + 1);
        return std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * v);
    }

  private:
    std::uint64_t key_;
};

/// A stationary Ornstein-Uhlenbeck process of standard deviation 1 at `count` nodes `step` apart,
/// stepped exactly [Gillespie1996].
std::vector<double> ornstein_uhlenbeck(const Random& random, int count, double step,
                                       double correlation);

}  // namespace verdigris
