// SPDX-License-Identifier: MIT
// The rules under which forecasters are judged, all of them as configuration. The defaults are the
// paper's, as far as its figures determine them (docs/PROTOCOL.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace verdigris {

/// Of which horizons a pixel must have changed to count as foreground.
enum class MaskRule {
    union_of_horizons,  ///< of any: one mask per window, so horizons are comparable
    per_horizon,        ///< of the horizon that is judged: the paper does not say which it means
};

/// Where forecasts apply and where foreground is looked for.
enum class EvaluatedArea {
    frame,     ///< every pixel, as the paper: nothing about the specimen is known
    specimen,  ///< the observation's specimen: what the product forecasts
};

struct EvaluationProtocol {
    /// Samples a recording must have; 984 is the paper's grid (docs/models/observe.md, 1).
    /// 0: as many as it has, for short recordings.
    int grid = 984;
    int trim_lead = 17, trim_tail = 17;  ///< samples left out at the ends: 950 of 984 remain
    int stride = 10;                     ///< samples per unit
    int context = 5;                     ///< observed frames n, one unit apart
    int horizons = 10;                   ///< forecast frames K, one unit apart
    double train_fraction = 0.5;         ///< of the grid, from the first usable sample on
    double validation_fraction = 0.25;   ///< of the grid, behind the embargo
    /// Samples between train and validation that neither uses. Default: one window's span.
    std::optional<int> embargo;

    int min_foreground = 64;    ///< windows with fewer foreground pixels are skipped, and counted
    std::optional<double> tau;  ///< foreground threshold; default max(2.40 sigma, tau_floor)
    double tau_floor = 5e-4;    ///< an eighth of an 8-bit step
    MaskRule mask{MaskRule::union_of_horizons};
    EvaluatedArea area{EvaluatedArea::frame};
    int max_windows = 0;  ///< evenly spaced among all; 0: all of them

    bool delta_e = true;        ///< also CIEDE2000: half of the cost of an evaluation
    bool out_of_gamut = false;  ///< also the share of pixels that leave [0, 1]
    bool hash_frames = true;    ///< so that the audit sees a frame that is used twice

    int bootstrap_draws = 10000;
    std::uint64_t seed = 0;
    bool single = false;  ///< one recording, training-free forecasters only: labeled as such
    /// Name of the one recording to hold out, for checkpoints that learned from the others; empty:
    /// each in turn.
    std::string hold_out;

    /// Samples from a window's first to its last: (n + K - 1) stride, 140.
    int span() const { return (context + horizons - 1) * stride; }
    int embargo_samples() const { return embargo.value_or(span()); }
};

/// Throws Error{usage} naming the option and its range; so also where train, embargo and validation
/// do not fit into the grid one after the other.
void check_protocol(const EvaluationProtocol& protocol);

/// For recordings of about 100 photographs: no grid, nothing trimmed, `stride` samples per unit.
EvaluationProtocol short_recording_protocol(int stride = 3);

std::string to_string(MaskRule rule);       ///< "union", "per-horizon"
std::string to_string(EvaluatedArea area);  ///< "frame", "specimen"

}  // namespace verdigris
