// SPDX-License-Identifier: MIT
#include "verdigris/learn/augment.h"

#include <torch/nn/functional/vision.h>

#include <numeric>
#include <random>
#include <utility>

namespace verdigris {
namespace {

constexpr double kStillShare =
    0.25;  // chosen: windows that are not resampled, whose noise is sharp
constexpr double kShift = 4, kLeastZoom = 0.85, kPhotometric = 0.06;  // [Paper]: 4 px, +-6 %

/// Mixes words into a seed (the finalizer of splitmix64).
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
    std::uint64_t z = a + 0x9e3779b97f4a7c15u * (b + 1);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// [0, 1), the same on every machine, which std::uniform_real_distribution does not promise.
double uniform(std::mt19937_64& random) {
    return double(random() >> 11) * 0x1p-53;
}
double uniform(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * uniform(random);
}

}  // namespace

WindowAugmentation draw_augmentation(std::uint64_t seed, std::int64_t step, int item) {
    std::mt19937_64 random(mixed(mixed(seed, std::uint64_t(step)), std::uint64_t(item)));
    WindowAugmentation a;
    a.flip = uniform(random) < 0.5;
    a.resample = uniform(random) >= kStillShare;
    a.shift_x = uniform(random, -kShift, kShift);
    a.shift_y = uniform(random, -kShift, kShift);
    a.zoom = uniform(random, kLeastZoom, 1);
    a.place_x = uniform(random, -1, 1);
    a.place_y = uniform(random, -1, 1);
    a.gain = uniform(random, 1 - kPhotometric, 1 + kPhotometric);
    a.bias = uniform(random, -kPhotometric, kPhotometric);
    return a;
}

torch::Tensor augmented(const torch::Tensor& windows,
                        const std::vector<WindowAugmentation>& augmentations) {
    namespace F = torch::nn::functional;
    const std::int64_t height = windows.size(3), width = windows.size(4);
    std::vector<torch::Tensor> out;
    for (std::size_t i = 0; i < augmentations.size(); ++i) {
        const WindowAugmentation& a = augmentations[i];
        torch::Tensor window = windows[std::int64_t(i)];
        if (!a.resample) {
            if (a.flip) window = window.flip({3});
        } else {
            // Time folds into channels: one grid for every frame.
            const double s = a.flip ? -a.zoom : a.zoom, room = 1 - a.zoom;
            const torch::Tensor theta =
                torch::tensor({s, 0.0, room * a.place_x + 2 * a.shift_x / double(width),  //
                               0.0, a.zoom, room * a.place_y + 2 * a.shift_y / double(height)},
                              torch::kFloat32)
                    .view({1, 2, 3})
                    .to(windows.device());
            const torch::Tensor folded = window.flatten(0, 1).unsqueeze(0);
            const torch::Tensor grid = F::affine_grid(theta, folded.sizes(), false);
            window = F::grid_sample(folded, grid,
                                    F::GridSampleFuncOptions()
                                        .mode(torch::kBilinear)
                                        .padding_mode(torch::kReflection)
                                        .align_corners(false))
                         .view_as(window);
        }
        out.push_back(window * a.gain + a.bias);
    }
    return torch::stack(out);
}

std::vector<int> shuffled(int count, std::uint64_t seed, int epoch) {
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    std::mt19937_64 random(mixed(mixed(seed, 0x5eed), std::uint64_t(epoch)));
    for (int i = count - 1; i > 0; --i) {  // Fisher and Yates; std::shuffle may differ elsewhere
        std::swap(order[std::size_t(i)], order[std::size_t(uniform(random) * (i + 1))]);
    }
    return order;
}

}  // namespace verdigris
