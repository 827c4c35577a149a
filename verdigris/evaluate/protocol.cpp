// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/protocol.h"

#include <fmt/core.h>

#include <cmath>

#include "verdigris/error.h"

namespace verdigris {
namespace {

void need(bool holds, const std::string& sentence) {
    if (!holds) throw Error(ErrorCode::usage, sentence);
}

// chosen: far beyond any recording, far below what overflows when multiplied.
constexpr int kMost = 1'000'000;

void in_range(const char* option, double value, double least, double most) {
    need(value >= least && value <= most, fmt::format("the protocol's {} is {}; it must be from "
                                                      "{} to {}",
                                                      option, value, least, most));
}

}  // namespace

void check_protocol(const EvaluationProtocol& p) {
    in_range("grid", p.grid, 0, kMost);
    in_range("trim_lead", p.trim_lead, 0, kMost);
    in_range("trim_tail", p.trim_tail, 0, kMost);
    in_range("stride", p.stride, 1, 10'000);
    in_range("context", p.context, 1, 1000);
    in_range("horizons", p.horizons, 1, 1000);
    in_range("train_fraction", p.train_fraction, 0, 1);
    in_range("validation_fraction", p.validation_fraction, 0, 1);
    if (p.embargo) in_range("embargo", *p.embargo, 0, kMost);
    in_range("min_foreground", p.min_foreground, 1, 1e9);
    if (p.tau) in_range("tau", *p.tau, 0, 1);
    in_range("tau_floor", p.tau_floor, 0, 1);
    in_range("max_windows", p.max_windows, 0, kMost);
    in_range("bootstrap_draws", p.bootstrap_draws, 100, 10'000'000);
    need(p.train_fraction + p.validation_fraction <= 1,
         fmt::format("the protocol's splits overlap: train_fraction {} and validation_fraction {} "
                     "make more than the whole recording",
                     p.train_fraction, p.validation_fraction));
    need(!p.single || p.hold_out.empty(),
         fmt::format("hold_out names '{}', but single holds nothing out", p.hold_out));
    if (p.grid == 0) return;  // the recordings decide how much there is
    const int usable = p.grid - p.trim_lead - p.trim_tail;
    need(usable > p.span(), fmt::format("the protocol's grid of {} samples leaves {} after "
                                        "trimming, and one window spans {}",
                                        p.grid, std::max(usable, 0), p.span() + 1));
    const int train = int(p.train_fraction * p.grid),
              validation = int(p.validation_fraction * p.grid);
    need(train + p.embargo_samples() + validation <= usable,
         fmt::format("the protocol's splits overlap: {} samples of training, {} of embargo and {} "
                     "of validation do not fit into the {} usable ones",
                     train, p.embargo_samples(), validation, usable));
}

EvaluationProtocol short_recording_protocol(int stride) {
    EvaluationProtocol protocol;
    protocol.grid = 0;
    protocol.trim_lead = protocol.trim_tail = 0;
    protocol.stride = stride;
    return protocol;
}

std::string to_string(MaskRule rule) {
    return rule == MaskRule::union_of_horizons ? "union" : "per-horizon";
}

std::string to_string(EvaluatedArea area) {
    return area == EvaluatedArea::frame ? "frame" : "specimen";
}

}  // namespace verdigris
