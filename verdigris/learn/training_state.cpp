// SPDX-License-Identifier: MIT
#include "verdigris/learn/training_state.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <type_traits>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/learn/tensor_file.h"

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kOptimizer = "optimizer/";

/// How an optimizer names a parameter: up to libtorch 2.0 by the text of its address, later by the
/// address.
using ParameterKey =
    std::remove_cvref_t<decltype(std::declval<torch::optim::AdamW&>().state())>::key_type;
template <class Key>
Key key_as(void* address) {
    if constexpr (std::is_same_v<Key, std::string>) {
        std::ostringstream text;
        text << address;
        return text.str();
    } else {
        return address;
    }
}
ParameterKey key_of(const torch::Tensor& parameter) {
    return key_as<ParameterKey>(parameter.unsafeGetTensorImpl());
}

Json json_of(const EpochRecord& e) {
    return {{"epoch", e.epoch},
            {"train_loss", e.train_loss},
            {"validation_error", e.validation_error},
            {"validation_persistence", e.validation_persistence},
            {"learning_rate", e.learning_rate},
            {"step_seconds", e.step_seconds},
            {"seconds", e.seconds}};
}

EpochRecord epoch_of(const Json& json) {
    return {json.at("epoch").get<int>(),
            json.at("train_loss").get<double>(),
            json.at("validation_error").get<double>(),
            json.at("validation_persistence").get<double>(),
            json.at("learning_rate").get<double>(),
            json.at("step_seconds").get<double>(),
            json.at("seconds").get<double>()};
}

}  // namespace

std::unique_ptr<torch::optim::AdamW> make_optimizer(NetworkModule& module, double learning_rate,
                                                    double weight_decay) {
    std::vector<torch::Tensor> decayed, free;
    for (const torch::Tensor& p : module.parameters()) (p.dim() >= 2 ? decayed : free).push_back(p);
    const auto options = [&](double decay) {
        return std::make_unique<torch::optim::AdamWOptions>(
            torch::optim::AdamWOptions(learning_rate).weight_decay(decay));
    };
    std::vector<torch::optim::OptimizerParamGroup> groups;
    groups.emplace_back(decayed, options(weight_decay));
    groups.emplace_back(free, options(0));
    return std::make_unique<torch::optim::AdamW>(groups, torch::optim::AdamWOptions(learning_rate));
}

void set_learning_rate(torch::optim::AdamW& optimizer, double learning_rate) {
    for (torch::optim::OptimizerParamGroup& group : optimizer.param_groups())
        static_cast<torch::optim::AdamWOptions&>(group.options()).lr(learning_rate);
}

void write_training_state(const std::filesystem::path& path, const NetworkConfig& config,
                          const TrainingFacts& facts, const std::vector<EpochRecord>& epochs,
                          const NetworkModule& module, torch::optim::AdamW& optimizer) {
    SafetensorsFile file;
    file.metadata = metadata_of(config, facts);
    Json list = Json::array();
    for (const EpochRecord& e : epochs) list.push_back(json_of(e));
    file.metadata["epochs"] = list.dump();
    store_weights(module, file);
    std::int64_t steps = 0;
    for (const auto& item : module.named_parameters()) {
        const auto& state = static_cast<const torch::optim::AdamWParamState&>(
            *optimizer.state().at(key_of(item.value())));
        steps = state.step();
        file.tensors.push_back(stored(kOptimizer + item.key() + "/mean", state.exp_avg()));
        file.tensors.push_back(stored(kOptimizer + item.key() + "/square", state.exp_avg_sq()));
    }
    file.metadata["optimizer_steps"] = std::to_string(steps);
    write_safetensors(path, file);
}

TrainingState read_training_state(const std::filesystem::path& path, const NetworkConfig& config,
                                  NetworkModule& module, torch::optim::AdamW& optimizer) {
    const std::string where = path.string();
    const SafetensorsFile file = read_safetensors(path);
    if (config_of(file.metadata, where) != config) {
        throw Error(ErrorCode::bad_input, "is the state of another network than is asked for",
                    where);
    }
    TrainingState state;
    state.facts = facts_of(file.metadata, where);
    std::int64_t steps = 0;
    try {
        for (const Json& e : Json::parse(file.metadata.at("epochs")))
            state.epochs.push_back(epoch_of(e));
        steps = std::stoll(file.metadata.at("optimizer_steps"));
    } catch (const std::exception&) {
        throw Error(ErrorCode::bad_input, "does not say what was trained so far", where);
    }
    if (int(state.epochs.size()) != state.facts.epoch || steps < 1) {
        throw Error(ErrorCode::bad_input, "does not say what was trained so far", where);
    }
    load_weights(file, where, kOptimizer, module);
    for (const auto& item : module.named_parameters()) {
        auto moments = std::make_unique<torch::optim::AdamWParamState>();
        moments->step(steps);
        for (const char* part : {"mean", "square"}) {
            const Tensor* tensor = file.find(fmt::format("{}{}/{}", kOptimizer, item.key(), part));
            if (tensor == nullptr || tensor->shape != item.value().sizes().vec()) {
                throw Error(ErrorCode::bad_input,
                            fmt::format("lacks the optimizer's state of '{}', or has it in another "
                                        "shape",
                                        item.key()),
                            where);
            }
            const torch::Tensor value = loaded(*tensor, where).to(item.value().device());
            if (part[0] == 'm') {
                moments->exp_avg(value);
            } else {
                moments->exp_avg_sq(value);
            }
        }
        optimizer.state()[key_of(item.value())] = std::move(moments);
    }
    return state;
}

std::vector<std::string> differing_options(const TrainingFacts& a, const TrainingFacts& b) {
    std::vector<std::string> list;
    const auto add = [&](bool differs, const char* name) {
        if (differs) list.emplace_back(name);
    };
    add(a.sources != b.sources, "its recordings, their samples or the splits");
    add(a.stride != b.stride, "--stride");
    add(a.horizons != b.horizons, "--horizons");
    add(a.epochs != b.epochs, "--epochs");
    add(a.batch != b.batch, "--batch");
    add(a.max_windows != b.max_windows, "--train-windows");
    add(a.threads != b.threads, "--threads");
    add(a.device != b.device, "--device");
    add(a.seed != b.seed, "--seed");
    add(a.learning_rate != b.learning_rate, "--learning-rate");
    add(a.weight_decay != b.weight_decay, "the weight decay");
    add(a.clip_norm != b.clip_norm, "the gradient's limit");
    add(a.augment != b.augment, "--no-augment");
    add(a.torch != b.torch, "the version of libtorch");
    return list;
}

std::string metrics_text(const std::vector<EpochRecord>& epochs) {
    std::string text;
    for (const EpochRecord& e : epochs) text += json_of(e).dump() + "\n";
    return text;
}

}  // namespace verdigris
