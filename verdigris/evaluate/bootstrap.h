// SPDX-License-Identifier: MIT
// How much of a gain the windows resolve. They overlap heavily, so three answers of different
// honesty: windows as if independent, whole blocks of them, and blocks at any offset of a circle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "verdigris/evaluate/scores.h"

namespace verdigris {

/// What is resampled together: a ratio of sums over windows, theta = sum(over) / sum(under).
/// A gain has over = persistence - model and under = persistence; the difference of two gains has
/// over = second - first. Paired: the same windows are drawn for both.
struct WindowRatios {
    std::vector<int> starts;          ///< first samples, increasing; need not be consecutive
    std::vector<double> over, under;  ///< per window, the mean over horizons
};
/// Of the foreground MSE. Throws Error{usage} if the direction scored no window.
WindowRatios gain_ratios(const Direction& direction, const EntrantScores& entrant);
/// gain(first) - gain(second): positive where the first is better.
WindowRatios difference_ratios(const Direction& direction, const EntrantScores& first,
                               const EntrantScores& second);

enum class BootstrapKind {
    naive,           ///< windows one by one, as if they were independent: too narrow
    block,           ///< what [Paper] describes: the non-overlapping blocks [Carlstein1986]
    circular_block,  ///< blocks at any offset, the end joined to the start [PolitisRomano1992]
};
std::string to_string(BootstrapKind kind);  ///< "naive", "block", "circular-block"

struct BootstrapOptions {
    int draws = 10000;       ///< of `naive`, `circular_block`, and `block` beyond 12 blocks
    std::uint64_t seed = 0;  ///< of the Mersenne twister
    double level = 0.95;     ///< share of the distribution inside the interval
    int block = 140;         ///< samples per block: one window's span
};

/// As the protocol says: its draws and seed, blocks of one span.
BootstrapOptions bootstrap_options(const EvaluationProtocol& protocol);

struct Interval {
    double low = 0, high = 0;
};

/// Percentile interval of theta. `block` puts the window that starts at s into block
/// (s - first start) / block and enumerates all multisets of blocks with their multinomial weights:
/// exact, 462 of them for 6 blocks. A last block with fewer than half as many windows as the
/// fullest is part of the one before it: drawn like a whole one, a window by itself would pass for
/// a block. `circular_block` draws blocks of consecutive starts, ceil(starts / block) of them, the
/// last one cut to length; a block that reaches the end goes on at the start, so that every window
/// is drawn as often as any other and the draws center on theta. Empty where `block` has fewer than
/// two blocks (naive: windows), or an `under` sum is 0. Same seed, same interval, on any machine.
/// Few blocks make intervals that are wide and still too narrow: see the measured coverage in
/// docs/PROTOCOL.md. Throws Error{usage}: sizes differ, starts do not increase, options.
std::optional<Interval> bootstrap(const WindowRatios& ratios, BootstrapKind kind,
                                  const BootstrapOptions& options = {});

/// theta of all windows.
double ratio(const WindowRatios& ratios);

/// theta of each block of `block` by itself: what an interval of six blocks is made of.
struct BlockGain {
    int first_start = 0, last_start = 0;  ///< of its windows
    int windows = 0;
    double value = 0;  ///< NaN if its `under` is 0
};
std::vector<BlockGain> block_gains(const WindowRatios& ratios, int block);

}  // namespace verdigris
