// SPDX-License-Identifier: MIT
// Networks as files: safetensors with everything about their making inside.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "verdigris/evaluate/windows.h"
#include "verdigris/learn/learn.h"

namespace verdigris {

/// One line of metrics.jsonl.
struct EpochRecord {
    int epoch = 0;                      ///< from 1
    double train_loss = 0;              ///< mean over its steps
    double validation_error = 0;        ///< mean foreground MSE over the validation windows
    double validation_persistence = 0;  ///< of holding still, on the same windows
    double learning_rate = 0;           ///< at its end
    double step_seconds = 0;  ///< median of its steps; like seconds, no part of best.safetensors
    double seconds = 0;       ///< not repeatable, and no part of best.safetensors
};

/// A recording that a network learned from.
struct LearnedSource {
    std::string recording;      ///< its name then
    std::string source_sha256;  ///< of its bytes
    std::string data_sha256;    ///< of the samples in both ranges (learned_data_hash)
    SampleRange train, validation;
    bool operator==(const LearnedSource&) const = default;
};

/// How a network came about; all of it is in the checkpoint.
struct TrainingFacts {
    std::vector<LearnedSource> sources;
    /// "a", "a and b", "a, b and c".
    std::string source_names() const;
    int stride = 10, horizons = 10;
    int epoch = 0;  ///< the one these weights are of, from 1
    int epochs = 0, batch = 0, max_windows = 0, threads = 0;
    std::string device;  ///< "cpu", "cuda"
    std::uint64_t seed = 0;
    double learning_rate = 0, weight_decay = 0, clip_norm = 0;
    bool augment = true;
    double validation_error = 0, validation_persistence = 0;
    std::string version;  ///< of Verdigris
    std::string torch;    ///< of libtorch
    bool operator==(const TrainingFacts&) const = default;
};

struct Checkpoint {
    std::shared_ptr<Network> network;
    TrainingFacts facts;
};

inline constexpr const char* kBestFile = "best.safetensors";
inline constexpr const char* kLastFile = "last.safetensors";
inline constexpr const char* kMetricsFile = "metrics.jsonl";

/// SHA-256 over the hashes of the samples in both ranges: the same recording observed the same way.
std::string learned_data_hash(const SampleStore& samples, SampleRange train, SampleRange validation,
                              const Progress& progress = {});

/// Written whole or not at all.
void write_checkpoint(const std::filesystem::path& path, const Network& network,
                      const TrainingFacts& facts);
/// Throws Error{bad_input} naming the file and what is wrong with it: no checkpoint of ours,
/// another network's tensors, a tensor of another shape, numbers that are not finite, damage.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace verdigris
