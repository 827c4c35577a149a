// SPDX-License-Identifier: MIT
// Training as the paper states it: windows of a recording's first half, selection on a later
// stretch of the same recording, nothing else seen. More than one recording may be learned from.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "verdigris/evaluate/evaluate.h"
#include "verdigris/learn/checkpoint.h"
#include "verdigris/learn/learn.h"
#include "verdigris/progress.h"

namespace verdigris {

/// Defaults are the paper's, or where it is silent those of docs/models/learn.md.
struct TrainOptions {
    NetworkKind kind{NetworkKind::patinanet};
    int epochs = 12;
    int batch = 4;                ///< windows per step
    std::uint64_t seed = 0;       ///< of weights, order and augmentation
    double learning_rate = 2e-4;  ///< at the first step; a cosine takes it to 0
    double weight_decay = 1e-2;   ///< of tensors with two dimensions or more
    double clip_norm = 1;         ///< of the gradient over all weights
    bool augment = true;
    int max_windows = 0;  ///< at most so many training windows, evenly spaced; 0: all
    Device device{Device::cpu};
    int threads = 0;  ///< of libtorch; 0: all cores. Another number, other last bits
    /// Go on from last.safetensors in the folder, if there is one; without it a folder that holds a
    /// run is refused.
    bool resume = false;
};

/// Throws Error{usage} naming the option and its range. train_network calls it; so can who has
/// something slow to do first.
void check_train_options(const TrainOptions& options);

/// After an epoch.
using EpochDone = std::function<void(const EpochRecord&)>;

struct TrainedNetwork {
    std::shared_ptr<const Network> network;  ///< of the epoch with the lowest validation error
    TrainingFacts facts;
    std::vector<EpochRecord> epochs;
};

/// Before a run that is not resumed, and before hours are spent on reading for it. Throws
/// Error{refused} where best.safetensors or last.safetensors is in the folder already.
void refuse_to_begin_over(const std::filesystem::path& folder);

/// Trains on `sources` (windows of all of them, mixed) and writes best.safetensors,
/// last.safetensors and metrics.jsonl into `folder` (made if absent) after every epoch, each whole
/// or not at all. Context, horizons, stride, splits and the foreground's threshold are the
/// protocol's; the area is always the frame and the mask the union of horizons. Samples are
/// stretched to a square of learned_size() (training_set.h), which must be the same for all
/// sources.
///
/// Loss, per batch: (MSE over the foreground + 0.1 MSE over all pixels) / m, m the mean foreground
/// MSE of persistence over the training windows; it starts near 1. Windows whose foreground is
/// under protocol.min_foreground count with their second term only. Selection: the protocol's
/// foreground MSE over all windows in the sources' validation ranges.
///
/// Same seed, same threads, same machine: same weights, whether interrupted and resumed or not.
/// Memory: the training samples as floats (97 MB at 128 x 128) and 1 to 3 GB of activations.
/// Progress stages: "load", "train" (steps of all epochs), "validate".
/// Throws Error{usage}: options. Error{bad_input}: sources of different sizes, too few
/// samples for a window, nothing that changes in the validation windows, a damaged state.
/// Error{refused}: the folder holds a run or a checkpoint of other options (named) or another
/// network, or one at all and it is not resumed, or is being written by another process; a source
/// twice; nothing changes in the training windows. Error{failed}: the loss or the validation error
/// is not a number (what was saved stays), disk full.
TrainedNetwork train_network(const EvaluationProtocol& protocol,
                             const std::vector<TrainingSource>& sources,
                             const TrainOptions& options, const std::filesystem::path& folder,
                             const Progress& progress = {}, const EpochDone& epoch_done = {});

}  // namespace verdigris
