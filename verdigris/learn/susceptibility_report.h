// SPDX-License-Identifier: MIT
// The susceptibility analysis to read: the paper's Figure 5, with what it leaves open.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "verdigris/color/pixel_types.h"
#include "verdigris/learn/susceptibility.h"
#include "verdigris/pixels/image.h"
#include "verdigris/report/page.h"

namespace verdigris {

/// Sections: verdict, agreement between windows, agreement with what changed, how it was done.
Report susceptibility_report(const Checkpoint& checkpoint, const SusceptibilityAnalysis& analysis);

/// A row per recording and per pair of recordings: r of their windows' maps.
Table susceptibility_table(const SusceptibilityAnalysis& analysis);
/// A row per recording: r of its mean map with what changed.
Table susceptibility_change_table(const SusceptibilityAnalysis& analysis);
Figure susceptibility_figure(const SusceptibilityAnalysis& analysis);

/// What the numbers say, a sentence each; "more" and "less" only beyond two standard errors of the
/// difference, errors added in quadrature.
std::vector<std::string> susceptibility_sentences(const SusceptibilityAnalysis& analysis);

/// A row per recording: its mean map, then what changed, each from black (least) to white (most of
/// the recording), enlarged threefold.
Image<SrgbU8> susceptibility_sheet(const SusceptibilityAnalysis& analysis);

nlohmann::ordered_json json_of(const SusceptibilityAnalysis& analysis);

}  // namespace verdigris
