// SPDX-License-Identifier: MIT
#include "verdigris/learn/tensor_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>
#include <utility>

#include "verdigris/error.h"

namespace verdigris {
namespace {

using Json = nlohmann::json;
constexpr const char* kFormat = "verdigris-checkpoint-1";
constexpr std::size_t kLongestText = 1 << 20;  // chosen: 3000 sources. Parsed, it is 50 times that

[[noreturn]] void bad(const std::string& where, const std::string& sentence) {
    throw Error(ErrorCode::bad_input, sentence, where);
}

const std::string& entry(const std::map<std::string, std::string>& metadata, const char* key,
                         const std::string& where) {
    const auto at = metadata.find(key);
    if (at == metadata.end())
        bad(where, fmt::format("is no checkpoint of Verdigris: its metadata has no '{}'", key));
    return at->second;
}

Json object_of(const std::map<std::string, std::string>& metadata, const char* key,
               const std::string& where) {
    const std::string& text = entry(metadata, key, where);
    if (text.size() > kLongestText) bad(where, fmt::format("its '{}' is too long", key));
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) bad(where, fmt::format("its '{}' is no JSON object", key));
    return json;
}

/// The JSON reader would make a whole number of 5.7, of true and of what does not fit.
template <class T>
bool holds(const Json& json) {
    if constexpr (std::is_same_v<T, bool>) {
        return json.is_boolean();
    } else if constexpr (std::is_integral_v<T>) {
        return json.is_number_unsigned()
                   ? std::in_range<T>(json.get<std::uint64_t>())
                   : json.is_number_integer() && std::in_range<T>(json.get<std::int64_t>());
    } else if constexpr (std::is_floating_point_v<T>) {
        return json.is_number();
    } else if constexpr (std::is_same_v<T, std::string>) {
        return json.is_string();
    } else {
        return json.is_array();
    }
}

template <class T>
T value_of(const Json& json, const char* key, const std::string& where) {
    const auto at = json.is_object() ? json.find(key) : json.end();
    if (at == json.end() || !holds<T>(*at))
        bad(where, fmt::format("its metadata lacks '{}', or has it as something else", key));
    return at->template get<T>();
}

SampleRange range_of(const Json& json, const char* key, const std::string& where) {
    const auto pair = value_of<std::vector<Json>>(json, key, where);
    if (pair.size() != 2 || !holds<int>(pair[0]) || !holds<int>(pair[1]) ||
        pair[0].get<int>() < 0 || pair[1].get<int>() < pair[0].get<int>()) {
        bad(where, fmt::format("its '{}' is no range of samples", key));
    }
    return {pair[0].get<int>(), pair[1].get<int>()};
}

}  // namespace

Tensor stored(const std::string& name, const torch::Tensor& tensor) {
    const torch::Tensor flat = tensor.detach().to(torch::kCPU, torch::kFloat32).contiguous();
    const std::span<const float> values(flat.data_ptr<float>(), std::size_t(flat.numel()));
    return float_tensor(name, flat.sizes().vec(), values);
}

torch::Tensor loaded(const Tensor& tensor, const std::string& where) {
    const std::vector<float> values = floats(tensor, where);
    torch::Tensor out = torch::empty(tensor.shape, torch::kFloat32);
    if (!values.empty())
        std::memcpy(out.data_ptr<float>(), values.data(), values.size() * sizeof(float));
    if (!torch::isfinite(out).all().item<bool>())
        bad(where, fmt::format("'{}' holds numbers that are not finite", tensor.name));
    return out;
}

void store_weights(const NetworkModule& module, SafetensorsFile& file) {
    for (const auto& item : module.named_parameters())
        file.tensors.push_back(stored(item.key(), item.value()));
}

void load_weights(const SafetensorsFile& file, const std::string& where, const std::string& allowed,
                  NetworkModule& module) {
    std::set<std::string> known;
    const torch::NoGradGuard frozen;
    for (const auto& item : module.named_parameters()) {
        known.insert(item.key());
        const Tensor* tensor = file.find(item.key());
        if (tensor == nullptr) bad(where, fmt::format("lacks the weights '{}'", item.key()));
        torch::Tensor parameter = item.value();
        if (parameter.sizes().vec() != tensor->shape) {
            bad(where, fmt::format("'{}' has the shape [{}] where the network has [{}]", item.key(),
                                   fmt::join(tensor->shape, ", "),
                                   fmt::join(parameter.sizes().vec(), ", ")));
        }
        parameter.copy_(loaded(*tensor, where));
    }
    for (const Tensor& tensor : file.tensors) {
        const bool expected =
            known.contains(tensor.name) || (!allowed.empty() && tensor.name.starts_with(allowed));
        if (!expected)
            bad(where, fmt::format("holds '{}', which its network does not have", tensor.name));
    }
}

std::map<std::string, std::string> metadata_of(const NetworkConfig& config,
                                               const TrainingFacts& f) {
    const Json network = {
        {"kind", to_string(config.kind)}, {"context", config.context}, {"size", config.size}};
    Json sources = Json::array();
    for (const LearnedSource& s : f.sources) {
        sources.push_back({{"recording", s.recording},
                           {"source_sha256", s.source_sha256},
                           {"data_sha256", s.data_sha256},
                           {"train", {s.train.begin, s.train.end}},
                           {"validation", {s.validation.begin, s.validation.end}}});
    }
    const Json training = {{"sources", std::move(sources)},
                           {"stride", f.stride},
                           {"horizons", f.horizons},
                           {"epoch", f.epoch},
                           {"epochs", f.epochs},
                           {"batch", f.batch},
                           {"max_windows", f.max_windows},
                           {"threads", f.threads},
                           {"device", f.device},
                           {"seed", f.seed},
                           {"learning_rate", f.learning_rate},
                           {"weight_decay", f.weight_decay},
                           {"clip_norm", f.clip_norm},
                           {"augment", f.augment},
                           {"validation_error", f.validation_error},
                           {"validation_persistence", f.validation_persistence},
                           {"version", f.version},
                           {"torch", f.torch}};
    const auto text = [](const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    return {{"format", kFormat}, {"network", text(network)}, {"training", text(training)}};
}

NetworkConfig config_of(const std::map<std::string, std::string>& metadata,
                        const std::string& where) {
    if (entry(metadata, "format", where) != kFormat)
        bad(where, fmt::format("is no checkpoint of Verdigris: its format is not {}", kFormat));
    const Json json = object_of(metadata, "network", where);
    NetworkConfig config;
    try {
        config.kind = network_kind(value_of<std::string>(json, "kind", where));
        config.context = value_of<int>(json, "context", where);
        config.size = value_of<int>(json, "size", where);
        check_network_config(config);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::bad_input) throw;
        bad(where, e.sentence());
    }
    return config;
}

TrainingFacts facts_of(const std::map<std::string, std::string>& metadata,
                       const std::string& where) {
    const Json json = object_of(metadata, "training", where);
    TrainingFacts f;
    const auto get = [&]<class T>(const char* key, T& value) {
        value = value_of<T>(json, key, where);
    };
    for (const Json& one : value_of<std::vector<Json>>(json, "sources", where)) {
        f.sources.push_back({value_of<std::string>(one, "recording", where),
                             value_of<std::string>(one, "source_sha256", where),
                             value_of<std::string>(one, "data_sha256", where),
                             range_of(one, "train", where), range_of(one, "validation", where)});
    }
    if (f.sources.empty()) bad(where, "does not say what its network learned from");
    get("stride", f.stride);
    get("horizons", f.horizons);
    get("epoch", f.epoch);
    get("epochs", f.epochs);
    get("batch", f.batch);
    get("max_windows", f.max_windows);
    get("threads", f.threads);
    get("device", f.device);
    get("seed", f.seed);
    get("learning_rate", f.learning_rate);
    get("weight_decay", f.weight_decay);
    get("clip_norm", f.clip_norm);
    get("augment", f.augment);
    get("validation_error", f.validation_error);
    get("validation_persistence", f.validation_persistence);
    get("version", f.version);
    get("torch", f.torch);
    if (f.stride < 1 || f.horizons < 1 || f.epoch < 1 || f.epochs < f.epoch)
        bad(where, "has a training in its metadata that cannot have been");
    return f;
}

}  // namespace verdigris
