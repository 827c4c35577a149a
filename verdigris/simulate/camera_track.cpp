// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verdigris/simulate/camera.h"
#include "verdigris/simulate/random.h"

namespace verdigris {
namespace {

double between(const std::vector<double>& nodes, double at) {
    const double s = std::clamp(at, 0.0, double(nodes.size() - 1));
    const std::size_t i = std::min(std::size_t(s), nodes.size() - 1);
    if (i + 1 == nodes.size()) return nodes.back();
    return std::lerp(nodes[i], nodes[i + 1], s - double(i));
}

}  // namespace

CameraTrack::CameraTrack(const SimulationSpec& spec) : spec_(spec) {
    const CameraSpec& c = spec_.camera;
    const int nodes = int(std::ceil(spec_.frames.units / kNodeUnits - 1e-9)) + 1;
    const auto drift = [&](RandomStream stream, std::uint64_t which, double correlation,
                           double deviation) {
        const Random random(Random(spec_.seed, stream).bits(which), stream);
        std::vector<double> values = ornstein_uhlenbeck(random, nodes, kNodeUnits, correlation);
        for (double& v : values) v *= deviation;
        return values;
    };
    light_ = drift(RandomStream::light, 0, c.light_correlation, c.light_drift);
    for (std::uint64_t i = 0; i < 3; ++i) {
        balance_[i] = drift(RandomStream::white_balance, i, c.white_balance_correlation,
                            c.white_balance * std::sqrt(1.5));
    }
    // A color balance moves the channels against each other: what they share is the exposure's. The
    // factor above keeps the asked deviation per channel.
    for (std::size_t i = 0; i < std::size_t(nodes); ++i) {
        const double shared = (balance_[0][i] + balance_[1][i] + balance_[2][i]) / 3;
        for (auto& channel : balance_) channel[i] -= shared;
    }
    const Random random(spec_.seed, RandomStream::jitter);
    jitter_.resize(std::size_t(nodes));
    for (std::size_t i = 0; i < jitter_.size(); ++i) jitter_[i] = c.jitter * random.gaussian(i);
}

void CameraTrack::see(double mean_luminance) {
    const CameraSpec& c = spec_.camera;
    const std::size_t node = exposure_log_.size();
    const double meter =
        std::log(std::max(mean_luminance, 1e-9)) + light_[std::min(node, light_.size() - 1)];
    if (node == 0) first_log_ = meter;
    exposure_log_.push_back(state_);
    const double wanted = c.auto_exposure * (first_log_ - meter);
    state_ += -std::expm1(-kNodeUnits / c.auto_exposure_lag) * (wanted - state_);
}

FrameGains CameraTrack::gains(double unit, int frame) const {
    const CameraSpec& c = spec_.camera;
    const double at = unit / kNodeUnits;
    FrameGains g;
    g.unit = unit;
    g.exposure = std::exp(between(exposure_log_, at));
    // Jitter holds for a sample: independent from one to the next, however many frames it has.
    const std::size_t sample = std::min(std::size_t(std::max(at, 0.0) + 1e-9), jitter_.size() - 1);
    g.light = std::exp(between(light_, at));
    g.jitter = std::exp(jitter_[sample]);
    g.flicker_phase = Random(spec_.seed, RandomStream::flicker).uniform(std::uint64_t(frame));
    const double share = std::clamp(unit / spec_.frames.units, 0.0, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
        g.balance[i] = std::exp(between(balance_[i], at));
        g.linear[i] = c.exposure * g.exposure * g.light * g.jitter * g.balance[i];
        g.encoded_gain[i] = std::lerp(1.0, c.drift_gain[i], share);
        g.encoded_offset[i] = c.drift_offset[i] * share;
    }
    return g;
}

}  // namespace verdigris
