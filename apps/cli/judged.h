// SPDX-License-Identifier: MIT
// What `evaluate`, `characterize` and `drift` share: recordings observed for judging, the protocol
// that fits them, and the folder the results go to.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "session.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/files/staged_folder.h"
#include "verdigris/observe/observe.h"
#include "verdigris/report/page.h"
#include "verdigris/report/write_results.h"

namespace verdigris::cli {

struct JudgeArguments {
    std::vector<std::string> recordings;
    std::string output, protocol, area, crop = "auto";
    int size = 128;
    std::optional<int> stride, context, horizons, windows;  ///< windows 0: all
    double tau = 0;                                         ///< 0: from the noise
    bool single = false;
    std::string hold_out;

    /// `several`: takes any number of recordings.
    void add(CLI::App& command, bool several);
    /// The folder and the protocol, without the recordings.
    void add_rules(CLI::App& command);
};

/// Every sample of each recording, at the size asked for, named after its file.
std::vector<Observation> observe_all(Session& session, const JudgeArguments& arguments);

/// What is wrong with the recordings, as cautions: for the end, after the results.
void tell_recordings(Session& session, const std::vector<Observation>& observations);

/// The protocol given, or the paper's where every recording has its 984 samples, else one for short
/// recordings; then single options. Says which.
EvaluationProtocol protocol_for(Session& session, const JudgeArguments& arguments,
                                const std::vector<Observation>& observations);

/// `auto`, `persistence`, `affinergb...` as training-free entrants. The affine family is the
/// paper's: no ridge, no clamp; "-ridge" behind a name gives it as the product has it, "-clamped"
/// the paper's with its drift stopped at the gamut. Names of checkpoints are left to
/// learned_entrants. With `furthest` > 0 "-in-range" behind any name keeps its colors in those of
/// the context, at whole units up to there.
/// Throws Error{usage} for a name that is none.
std::vector<Entrant> entrants_from(const std::string& names, int furthest = 0);
/// The checkpoints among them.
std::vector<std::string> checkpoints_among(const std::string& names);

/// Names of what is in a result folder.
inline constexpr const char* kEvaluationFile = "evaluation.json";
inline constexpr const char* kRecordFile = "record.json";
inline constexpr const char* kProtocolFile = "protocol.toml";
inline constexpr const char* kCharacterizationFile = "characterization.json";
inline constexpr const char* kDriftFile = "drift.json";
inline constexpr const char* kMaterialsFile = "materials.json";
inline constexpr const char* kRendersFolder = "renders";
/// In a folder of `reproduce` from its first moment on; what was asked for.
inline constexpr const char* kReproductionFile = "reproduction.json";
inline constexpr const char* kDriftMapsFile = "drift_gains.csv";

/// A folder belongs to the command whose `mark` (kEvaluationFile ...) is in it, and is replaced by
/// that one only. Throws Error{refused} if it holds a result of another, or a file of somebody's
/// own where ours would go; and, unless forced, if it holds anything else and is no result of ours.
void check_results_folder(const std::filesystem::path& output, const char* mark, bool force);

/// Writes report, tables, figures, what `more` writes and the list of them all, at once; tells the
/// statuses. What an earlier result of this folder had more goes, unless somebody changed it.
void deliver_results(Session& session, const std::filesystem::path& output, const Report& report,
                     const std::vector<Table>& data,
                     const std::function<void(const std::filesystem::path&)>& more);

}  // namespace verdigris::cli
