// SPDX-License-Identifier: MIT
// A printed value beside ours, in words that follow from the two and say no more than the blocks
// give (internal).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verdigris/results/resolved.h"

namespace verdigris {

/// "same sign", "opposite signs", "one of the two is zero as printed".
std::string signs_in_words(double paper, double ours);

/// "affinergb: +13.4 % in the paper, -59.4 % here: opposite signs; the paper's value lies outside
/// our block interval -114.6 % to -18.2 %, which excludes zero." Both are fractions.
/// Where there is no interval: why.
std::string compare_gain(const std::string& what, double paper, const Resolved& ours);

/// "persistence: 2.14e-04 in the paper, 8.42e-05 here, 0.39 times as much."
std::string compare_error(const std::string& what, double paper, double ours);

/// "r between specimens: +0.34 in the paper, +0.32 ± 0.03 here: within two standard errors of it."
/// `error` NaN: none is known, and nothing is said of it.
std::string compare_correlation(const std::string& what, double paper, double ours, double error);

struct NamedGain {
    std::string name;
    double gain = 0;  ///< a fraction; NaN where there is none
    /// Of ours only: do the blocks settle its sign?
    std::optional<bool> settled = {};
};
/// "Better than holding still in the paper: affinergb; here: none (of 2), ..." Persistence is not
/// among them.
std::string compare_winners(const std::string& where, const std::vector<NamedGain>& paper,
                            const std::vector<NamedGain>& ours);

/// Which of the names has the least error: "" where none has a number.
std::string least(const std::vector<std::pair<std::string, double>>& errors);

/// "a, b and c"; "none" of nothing.
std::string in_a_row(const std::vector<std::string>& names);

}  // namespace verdigris
