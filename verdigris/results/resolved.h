// SPDX-License-Identifier: MIT
// A gain, or a difference of gains, said only as far as its blocks resolve it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "verdigris/evaluate/bootstrap.h"
#include "verdigris/report/table.h"

namespace verdigris {

/// chosen: of four blocks or fewer a percentile interval is little more than their range, and none
/// is shown.
inline constexpr std::size_t kFewBlocks = 5;

struct Resolved {
    double value = 0;  ///< NaN if there is no window, or nothing to divide by
    int windows = 0;
    std::optional<Interval> block;  ///< of the non-overlapping blocks
    std::vector<BlockGain> blocks;
};

/// Of ratios without windows: not a number, no block.
Resolved resolved(const WindowRatios& ratios, const BootstrapOptions& options);

/// first - second where both were scored on the same windows (paired).
/// Throws Error{usage} if they were not.
WindowRatios paired_difference(const WindowRatios& first, const WindowRatios& second);

/// A gain as it is printed, to 0.1 %, so that words and numbers agree: -1, 0 or 1.
int printed_sign(double fraction);

/// Five blocks or more, and the interval as printed leaves zero outside: of an end that reads 0.0 %
/// nobody can see on which side it lies.
bool sign_is_settled(const Resolved& r);
/// "3 of 6 blocks", "3 of 6 blocks and equal in 2": those whose gain as printed is above zero.
std::string blocks_better(const std::vector<BlockGain>& blocks);
/// "the block interval -1.0 % to +3.0 % includes zero, so the sign is not settled"; "3 blocks are
/// too few to say how sure that is".
std::string how_sure(const Resolved& r);

/// "+12.3 %"; "0.0 %" for what rounds to it.
std::string signed_percent(double fraction);
/// The value with its interval; missing where it is no number.
TableCell cell_of(const Resolved& r);
/// {"gain", "interval": [low, high] | null, "windows", "blocks": [...]}; null for what is no
/// number.
nlohmann::ordered_json json_of(const Resolved& r);

}  // namespace verdigris
