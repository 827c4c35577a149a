// SPDX-License-Identifier: MIT
// The transfer study to read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "verdigris/report/page.h"
#include "verdigris/study/transfer_study.h"

namespace verdigris {

/// Sections: verdict, one thing changed at a time, more specimens, how it was done.
Report transfer_report(const TransferStudy& study);

/// What the intervals allow to say, a sentence per preset and network.
std::vector<std::string> transfer_sentences(const TransferStudy& study);

Table transfer_effect_table(const TransferStudy& study);
/// A row per preset, forecaster and cell of the factorial: gain, mean over seeds and its interval.
Table transfer_cell_table(const TransferStudy& study);
Table specimen_count_table(const TransferStudy& study);
/// Every score, for recomputing.
Table transfer_scores(const TransferStudy& study);
Figure transfer_figure(const TransferStudy& study);
Figure specimen_count_figure(const TransferStudy& study);

nlohmann::ordered_json json_of(const TransferStudy& study);

}  // namespace verdigris
