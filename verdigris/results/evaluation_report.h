// SPDX-License-Identifier: MIT
// An evaluation as a report: the verdict in sentences, the tables and figures it follows from.
#pragma once

#include <string>
#include <vector>

#include "verdigris/evaluate/bootstrap.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/report/page.h"
#include "verdigris/results/protocol_file.h"

namespace verdigris {

/// One forecaster on one held-out recording, with what the windows resolve. Computed once: the
/// bootstraps cost ~0.1 s each.
struct EntrantVerdict {
    std::string name;
    double error = 0, persistence = 0;  ///< mean foreground MSE
    double gain = 0;
    std::optional<Interval> naive, block, circular_block;
    std::vector<BlockGain> blocks;
    struct Named {
        NamedBlock block;
        int windows = 0;
        double gain = 0;  ///< NaN if no window starts there
    };
    std::vector<Named> named;
    /// In words, with its numbers: better or worse, by how much, how sure.
    std::string sentence;
};
/// Two forecasters on the same windows.
struct PairVerdict {
    std::string first, second;
    double difference = 0;  ///< gain(first) - gain(second): positive where the first is better
    std::optional<Interval> block, circular_block;  ///< paired: the same windows drawn for both
};
struct DirectionVerdict {
    const Direction* direction = nullptr;
    std::vector<EntrantVerdict> entrants;  ///< persistence left out
    std::vector<PairVerdict> pairs;        ///< all of them, while there are at most six entrants
};

/// `evaluation` must outlive the result. Blocks of recordings that were not evaluated are an
/// Error{usage}.
std::vector<DirectionVerdict> verdicts(const Evaluation& evaluation,
                                       const std::vector<NamedBlock>& blocks = {});

/// What the page and the terminal say first: of each direction a sentence per forecaster, or, where
/// none was judged but persistence, how large an error there is to improve on.
std::vector<std::string> verdict_sentences(const std::vector<DirectionVerdict>& verdicts);

/// Sections: verdict, audit, errors, the forecasters' own intervals, intervals and blocks (of
/// forecasters besides persistence), horizons, protocol.
Report evaluation_report(const Evaluation& evaluation,
                         const std::vector<DirectionVerdict>& verdicts);

/// Every error per forecaster, window and horizon: all else can be computed again from it.
Table window_errors(const Evaluation& evaluation);

/// The tables, apart from the page.
Table error_table(const Evaluation& evaluation);
/// How often the truth lay inside the intervals that forecasters state; no rows where none does.
Table coverage_table(const Evaluation& evaluation);
Table interval_table(const std::vector<DirectionVerdict>& verdicts);
Table pair_table(const std::vector<DirectionVerdict>& verdicts);
Table block_table(const std::vector<DirectionVerdict>& verdicts);
Table window_count_table(const Evaluation& evaluation);
Figure horizon_figure(const Evaluation& evaluation);
Figure gain_figure(const std::vector<DirectionVerdict>& verdicts);

}  // namespace verdigris
