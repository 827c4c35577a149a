// SPDX-License-Identifier: MIT
// Torch's tensors as a safetensors file has them, and what a checkpoint says of itself (internal).
#pragma once

#include <torch/types.h>

#include <map>
#include <string>

#include "verdigris/files/safetensors.h"
#include "verdigris/learn/checkpoint.h"
#include "verdigris/learn/network_module.h"

namespace verdigris {

Tensor stored(const std::string& name, const torch::Tensor& tensor);
/// float32, from any type of floats. Throws Error{bad_input} naming the tensor and `where`.
torch::Tensor loaded(const Tensor& tensor, const std::string& where);

void store_weights(const NetworkModule& module, SafetensorsFile& file);
/// Every parameter, each of its shape and finite, and nothing else but what begins with `allowed`.
void load_weights(const SafetensorsFile& file, const std::string& where, const std::string& allowed,
                  NetworkModule& module);

std::map<std::string, std::string> metadata_of(const NetworkConfig& config,
                                               const TrainingFacts& facts);
NetworkConfig config_of(const std::map<std::string, std::string>& metadata,
                        const std::string& where);
TrainingFacts facts_of(const std::map<std::string, std::string>& metadata,
                       const std::string& where);

}  // namespace verdigris
