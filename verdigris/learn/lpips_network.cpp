// SPDX-License-Identifier: MIT
#include "verdigris/learn/lpips_network.h"

#include <fmt/format.h>

namespace verdigris {
namespace {

LpipsLayer convolution(int index, int in, int out, int kernel, int stride, int padding, bool seen) {
    return {LpipsLayer::convolution, index, in, out, kernel, stride, padding, 0, seen};
}
LpipsLayer pool(int kernel) {
    return {.kind = LpipsLayer::pool, .kernel = kernel, .stride = 2};
}
LpipsLayer fire(int index, int in, int squeezed, int out, bool seen) {
    return {.kind = LpipsLayer::fire,
            .index = index,
            .in = in,
            .out = out,
            .squeezed = squeezed,
            .seen = seen};
}

std::vector<LpipsLayer> alex() {
    return {convolution(0, 3, 64, 11, 4, 2, true),   pool(3),
            convolution(3, 64, 192, 5, 1, 2, true),  pool(3),
            convolution(6, 192, 384, 3, 1, 1, true), convolution(8, 384, 256, 3, 1, 1, true),
            convolution(10, 256, 256, 3, 1, 1, true)};
}

std::vector<LpipsLayer> vgg() {
    struct Block {
        int channels, convolutions;
    };
    std::vector<LpipsLayer> layers;
    int index = 0, in = 3;
    for (const auto& [channels, convolutions] :
         {Block{64, 2}, Block{128, 2}, Block{256, 3}, Block{512, 3}, Block{512, 3}}) {
        if (!layers.empty()) {
            layers.push_back(pool(2));
            ++index;
        }
        for (int i = 0; i < convolutions; ++i) {
            layers.push_back(convolution(index, in, channels, 3, 1, 1, i + 1 == convolutions));
            index += 2;  // the ReLU is a module of its own
            in = channels;
        }
    }
    return layers;
}

std::vector<LpipsLayer> squeeze() {
    return {convolution(0, 3, 64, 3, 2, 0, true),
            pool(3),
            fire(3, 64, 16, 128, false),
            fire(4, 128, 16, 128, true),
            pool(3),
            fire(6, 128, 32, 256, false),
            fire(7, 256, 32, 256, true),
            pool(3),
            fire(9, 256, 48, 384, true),
            fire(10, 384, 48, 384, true),
            fire(11, 384, 64, 512, true),
            fire(12, 512, 64, 512, true)};
}

torch::Tensor convolved(const LpipsWeights& weights, const std::string& name,
                        const torch::Tensor& x, int stride, int padding) {
    return torch::conv2d(x, weights.at(name + ".weight"), weights.at(name + ".bias"), stride,
                         padding)
        .relu_();
}

}  // namespace

std::vector<LpipsLayer> lpips_layers(LpipsNet net) {
    switch (net) {
        case LpipsNet::alex:
            return alex();
        case LpipsNet::vgg:
            return vgg();
        case LpipsNet::squeeze:
            return squeeze();
    }
    return {};
}

bool pools_past_the_end(LpipsNet net) {
    return net == LpipsNet::squeeze;
}

LpipsShapes lpips_shapes(LpipsNet net) {
    LpipsShapes shapes;
    const auto add = [&](const std::string& name, int in, int out, int kernel) {
        shapes[name + ".weight"] = {out, in, kernel, kernel};
        shapes[name + ".bias"] = {out};
    };
    int heads = 0;
    for (const LpipsLayer& layer : lpips_layers(net)) {
        const std::string name = fmt::format("features.{}", layer.index);
        if (layer.kind == LpipsLayer::convolution) add(name, layer.in, layer.out, layer.kernel);
        if (layer.kind == LpipsLayer::fire) {
            add(name + ".squeeze", layer.in, layer.squeezed, 1);
            add(name + ".expand1x1", layer.squeezed, layer.out / 2, 1);
            add(name + ".expand3x3", layer.squeezed, layer.out / 2, 3);
        }
        if (layer.seen) shapes[fmt::format("lin{}.weight", heads++)] = {1, layer.out, 1, 1};
    }
    return shapes;
}

torch::Tensor apply(const LpipsLayer& layer, bool past_the_end, const LpipsWeights& weights,
                    const torch::Tensor& x) {
    const std::string name = fmt::format("features.{}", layer.index);
    if (layer.kind == LpipsLayer::pool)
        return torch::max_pool2d(x, layer.kernel, layer.stride, 0, 1, past_the_end);
    if (layer.kind == LpipsLayer::convolution)
        return convolved(weights, name, x, layer.stride, layer.padding);
    const torch::Tensor squeezed = convolved(weights, name + ".squeeze", x, 1, 0);
    return torch::cat({convolved(weights, name + ".expand1x1", squeezed, 1, 0),
                       convolved(weights, name + ".expand3x3", squeezed, 1, 1)},
                      1);
}

}  // namespace verdigris
