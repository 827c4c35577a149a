// SPDX-License-Identifier: MIT
// Everything an interrupted run needs to go on as if nothing had happened (internal).
#pragma once

#include <torch/optim/adamw.h>

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/learn/checkpoint.h"
#include "verdigris/learn/network_module.h"

namespace verdigris {

/// AdamW as the house sets it: decay of weights with two dimensions or more, none of the others.
std::unique_ptr<torch::optim::AdamW> make_optimizer(NetworkModule& module, double learning_rate,
                                                    double weight_decay);
void set_learning_rate(torch::optim::AdamW& optimizer, double learning_rate);

/// last.safetensors: weights, the optimizer's moments, what has been done so far. `facts` are those
/// of the last epoch.
void write_training_state(const std::filesystem::path& path, const NetworkConfig& config,
                          const TrainingFacts& facts, const std::vector<EpochRecord>& epochs,
                          const NetworkModule& module, torch::optim::AdamW& optimizer);

struct TrainingState {
    TrainingFacts facts;
    std::vector<EpochRecord> epochs;
};
/// Into `module` and `optimizer`, which were made for `config`. Throws Error{bad_input}: damage, or
/// a state of another network.
TrainingState read_training_state(const std::filesystem::path& path, const NetworkConfig& config,
                                  NetworkModule& module, torch::optim::AdamW& optimizer);

/// What of two runs differs, as the command line calls it; epoch, errors and version do not count.
std::vector<std::string> differing_options(const TrainingFacts& a, const TrainingFacts& b);

/// metrics.jsonl as a whole, a line per epoch.
std::string metrics_text(const std::vector<EpochRecord>& epochs);

}  // namespace verdigris
