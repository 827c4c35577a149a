// SPDX-License-Identifier: MIT
// The three networks under LPIPS, layer by layer (internal).
#pragma once

#include <torch/types.h>

#include <map>
#include <string>
#include <vector>

#include "verdigris/learn/lpips.h"

namespace verdigris {

/// A layer and the ReLU behind it; `index` is its place in torchvision's `features`.
struct LpipsLayer {
    enum Kind { convolution, pool, fire } kind;
    int index = 0;
    int in = 0, out = 0;                      ///< channels; of a fire layer all it puts out
    int kernel = 0, stride = 1, padding = 0;  ///< of a pool: no padding
    int squeezed = 0;                         ///< channels between the halves of a fire layer
    bool seen = false;                        ///< a head looks at what comes out
};

/// Source: torchvision's alexnet, vgg16, squeezenet1_1 (`features`), cut where [Zhang2018] cut
/// them.
std::vector<LpipsLayer> lpips_layers(LpipsNet net);
/// Windows that stick out at the end count too; of SqueezeNet only.
bool pools_past_the_end(LpipsNet net);

using LpipsShapes = std::map<std::string, std::vector<std::int64_t>>;
/// Every tensor of a weights file, heads included, and its shape.
LpipsShapes lpips_shapes(LpipsNet net);

using LpipsWeights = std::map<std::string, torch::Tensor>;
/// One layer of a batch [B, C, H, W].
torch::Tensor apply(const LpipsLayer& layer, bool past_the_end, const LpipsWeights& weights,
                    const torch::Tensor& x);

}  // namespace verdigris
