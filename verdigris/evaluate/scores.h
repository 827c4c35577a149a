// SPDX-License-Identifier: MIT
// What an evaluation found out: errors per window and horizon, from which every table follows.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "verdigris/evaluate/protocol.h"
#include "verdigris/evaluate/windows.h"
#include "verdigris/status.h"

namespace verdigris {

/// One number per window and horizon, row-major. Horizon k = 0 .. K-1 is t + (k + 1) units.
struct ErrorTable {
    int windows = 0, horizons = 0;
    std::vector<double> values;

    ErrorTable() = default;
    ErrorTable(int windows_, int horizons_)
        : windows(windows_),
          horizons(horizons_),
          values(std::size_t(windows_) * std::size_t(horizons_)) {}
    double& at(int window, int k) {
        return values[std::size_t(window) * std::size_t(horizons) + std::size_t(k)];
    }
    double at(int window, int k) const {
        return values[std::size_t(window) * std::size_t(horizons) + std::size_t(k)];
    }
    bool empty() const { return values.empty(); }
};

/// Means over windows of the per-window values (not pooled pixels), per horizon; their mean over
/// horizons; and per window the mean over horizons, which is what the bootstraps resample.
std::vector<double> horizon_means(const ErrorTable& table);
double overall_mean(const ErrorTable& table);
/// Of the values that are numbers; NaN if there are none. Per horizon.
std::vector<double> known_means(const ErrorTable& table);
std::vector<double> window_means(const ErrorTable& table);

/// Improvement over a reference, 1 - model / reference: a ratio of means ([Paper], Table 1), never
/// a mean of ratios. 0.134 is 13.4 %. NaN if the reference is 0.
double gain_over(double model_mean, double reference_mean);

/// One forecaster on one held-out recording. Tables have one row per scored window of the
/// Direction; all entrants share them.
struct EntrantScores {
    std::string name;
    bool trained = false;
    ErrorTable foreground;           ///< MSE over foreground pixels (masked_error.h)
    ErrorTable specimen;             ///< MSE over the whole specimen
    ErrorTable absolute;             ///< mean |error| over the specimen; of persistence: the change
    ErrorTable delta_e;              ///< mean CIEDE2000 over the specimen; empty if not asked for
    std::array<ErrorTable, 3> bias;  ///< mean forecast - truth over the specimen: r, g, b
    /// Share of the area's pixels with a channel outside [0, 1] in the unclamped forecast, and
    /// outside by more than 1/255; empty if not asked for.
    ErrorTable outside, outside_by_a_step;
    /// Shares inside the forecast's own nominal intervals (coverage.h); NaN where it states none.
    ErrorTable pixels80, pixels95, mean80, mean95;
};

struct SkippedWindow {
    int start = 0;
    std::string why;
};

/// One held-out recording.
struct Direction {
    std::string held_out;
    std::vector<std::string> sources;  ///< the other recordings; empty: within-recording
    double sigma = 0;                  ///< noise of one sample of the held-out recording
    double tau = 0;                    ///< foreground threshold that was used
    WindowPlan plan;
    std::vector<int> starts;  ///< first samples of the scored windows, increasing
    std::vector<SkippedWindow> skipped;
    std::vector<std::int64_t> foreground_pixels;  ///< per scored window; the least of its horizons
    std::int64_t specimen_pixels = 0;
    std::vector<EntrantScores> entrants;  ///< persistence first, then in the order given

    /// "chamber -> air"; "chamber + lab -> air"; "within air".
    std::string label() const;
    const EntrantScores& persistence() const { return entrants.front(); }
    /// Throws Error{usage} listing the names.
    const EntrantScores& entrant(const std::string& name) const;
};

/// Mean foreground gain of an entrant over persistence, and per horizon.
double gain(const Direction& direction, const EntrantScores& entrant);
std::vector<double> horizon_gains(const Direction& direction, const EntrantScores& entrant);

}  // namespace verdigris
