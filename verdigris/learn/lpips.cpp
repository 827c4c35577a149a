// SPDX-License-Identifier: MIT
#include "verdigris/learn/lpips.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/safetensors.h"
#include "verdigris/learn/lpips_network.h"
#include "verdigris/learn/tensor_file.h"

namespace verdigris {
namespace {

constexpr std::array<std::pair<LpipsNet, std::string_view>, 3> kNames{
    {{LpipsNet::alex, "alex"}, {LpipsNet::vgg, "vgg"}, {LpipsNet::squeeze, "squeeze"}}};

[[noreturn]] void bad(const std::string& where, const std::string& sentence) {
    throw Error(ErrorCode::bad_input, sentence, where);
}

/// Throws unless `metadata` says which net of version 0.1 this is.
LpipsNet net_of(const std::map<std::string, std::string>& metadata, const std::string& where) {
    const auto entry = [&](const char* key) {
        const auto at = metadata.find(key);
        if (at == metadata.end())
            bad(where, fmt::format("does not hold weights of LPIPS: its metadata has no '{}' "
                                   "(docs/models/metrics.md says how such a file is made)",
                                   key));
        return at->second;
    };
    const std::string version = entry("version"), name = entry("net");
    if (version != kLpipsVersion)
        bad(where, fmt::format("holds LPIPS of version '{}', and {} is what is computed", version,
                               kLpipsVersion));
    for (const auto& [net, known] : kNames) {
        if (name == known) return net;
    }
    bad(where, fmt::format("holds LPIPS of '{}', which is none of alex, vgg and squeeze", name));
}

LpipsWeights weights_of(const SafetensorsFile& file, LpipsNet net, const std::string& where) {
    const LpipsShapes shapes = lpips_shapes(net);
    LpipsWeights weights;
    for (const Tensor& tensor : file.tensors) {
        const auto expected = shapes.find(tensor.name);
        if (expected == shapes.end())
            bad(where, fmt::format("holds '{}', which LPIPS of {} does not have", tensor.name,
                                   to_string(net)));
        if (expected->second != tensor.shape)
            bad(where, fmt::format("'{}' has the shape [{}] where LPIPS of {} has [{}]",
                                   tensor.name, fmt::join(tensor.shape, ", "), to_string(net),
                                   fmt::join(expected->second, ", ")));
        const torch::Tensor values = loaded(tensor, where);
        if (tensor.name.starts_with("lin") && (values < 0).any().item<bool>())
            bad(where, fmt::format("'{}' holds a negative weight, with which differences would "
                                   "make pictures more alike",
                                   tensor.name));
        weights[tensor.name] = values;
    }
    for (const auto& [name, shape] : shapes) {
        if (!weights.contains(name)) bad(where, fmt::format("lacks the weights '{}'", name));
    }
    return weights;
}

// [Zhang2018], code of version 0.1: mean and spread of the channels that the networks were trained
// on, for inputs in [-1, 1].
constexpr std::array<float, 3> kShift{-0.030f, -0.088f, -0.188f}, kScale{0.458f, 0.448f, 0.450f};

/// [1, 3, H, W].
torch::Tensor network_input(ImageView<const SrgbF> image) {
    torch::Tensor out = torch::empty({1, 3, image.height(), image.width()});
    float* plane = out.data_ptr<float>();
    const std::array<float SrgbF::*, 3> channels{&SrgbF::r, &SrgbF::g, &SrgbF::b};
    for (std::size_t c = 0; c < 3; ++c) {
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const float v = image.row(y)[x].*channels[c];
                const float limited = v > 0 ? std::min(v, 1.0f) : 0.0f;
                *plane++ = (2 * limited - 1 - kShift[c]) / kScale[c];
            }
        }
    }
    return out;
}

/// Channels of each pixel scaled to length 1.
torch::Tensor directions(const torch::Tensor& x) {
    constexpr double kTiny = 1e-10;  // as in their code: nothing seen has no direction
    return x / (x.square().sum(1, true).sqrt_() + kTiny);
}

/// torch::mean cuts its sum by the number of threads.
double mean_in_order(const torch::Tensor& map) {
    const torch::Tensor flat = map.contiguous();
    const float* values = flat.data_ptr<float>();
    return std::accumulate(values, values + flat.numel(), 0.0) / double(flat.numel());
}

}  // namespace

struct Lpips::Parts {
    LpipsNet net;
    LpipsWeights weights;
};

std::string to_string(LpipsNet net) {
    for (const auto& [known, name] : kNames) {
        if (net == known) return std::string(name);
    }
    return {};
}

LpipsNet lpips_net(std::string_view name) {
    for (const auto& [net, known] : kNames) {
        if (name == known) return net;
    }
    throw Error(ErrorCode::usage,
                fmt::format("there is no LPIPS of '{}'; choose alex, vgg or squeeze", name));
}

int lpips_smallest(LpipsNet net) {
    return net == LpipsNet::alex ? 31 : net == LpipsNet::vgg ? 16 : 17;
}

Lpips::Lpips(const std::filesystem::path& path) {
    const std::string where = path.string();
    const LpipsNet net = net_of(read_safetensors_metadata(path), where);
    parts_ = std::make_unique<Parts>(Parts{net, weights_of(read_safetensors(path), net, where)});
}
Lpips::~Lpips() = default;
Lpips::Lpips(Lpips&&) noexcept = default;
Lpips& Lpips::operator=(Lpips&&) noexcept = default;

LpipsNet Lpips::net() const {
    return parts_->net;
}

double Lpips::distance(ImageView<const SrgbF> first, ImageView<const SrgbF> second) const {
    const int smallest = lpips_smallest(net());
    if (first.width() != second.width() || first.height() != second.height())
        throw Error(ErrorCode::bad_input,
                    fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared",
                                first.width(), first.height(), second.width(), second.height()));
    if (first.width() < smallest || first.height() < smallest)
        throw Error(
            ErrorCode::bad_input,
            fmt::format("LPIPS of {} needs pictures of at least {} x {} pixels; these "
                        "have {} x {}",
                        to_string(net()), smallest, smallest, first.width(), first.height()));
    const torch::NoGradGuard frozen;
    torch::Tensor a = network_input(first), b = network_input(second);
    const bool past_the_end = pools_past_the_end(net());
    double sum = 0;
    int head = 0;
    // Layer by layer, so that no more is held than one layer of both.
    for (const LpipsLayer& layer : lpips_layers(net())) {
        a = apply(layer, past_the_end, parts_->weights, a);
        b = apply(layer, past_the_end, parts_->weights, b);
        if (!layer.seen) continue;
        const torch::Tensor& weight = parts_->weights.at(fmt::format("lin{}.weight", head++));
        const torch::Tensor change = (directions(a) - directions(b)).square_();
        sum += mean_in_order(torch::conv2d(change, weight));
    }
    return sum;
}

}  // namespace verdigris
