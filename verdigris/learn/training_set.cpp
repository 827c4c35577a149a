// SPDX-License-Identifier: MIT
#include "verdigris/learn/training_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/evaluate/foreground.h"
#include "verdigris/learn/network_module.h"
#include "verdigris/learn/tensor_image.h"

namespace verdigris {
namespace {

constexpr double kAllPixels = 0.1;  // chosen: the backdrop must not drift, but does not lead

}  // namespace

TrainingSet::TrainingSet(const EvaluationProtocol& protocol, const Observation& observation,
                         SampleRange range, const Progress& progress)
    : stride_(protocol.stride),
      frames_(protocol.context + protocol.horizons),
      count_(windows_inside(range, protocol.span())),
      tau_(foreground_threshold(protocol, observation.noise.sigma)) {
    const int size = learned_size(observation.width(), observation.height());
    if (count_ < 1) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("{} samples leave no window of {} to learn from", range.count(),
                                protocol.span() + 1),
                    observation.source_name);
    }
    samples_ = torch::empty({range.count(), 3, size, size});
    for (int i = 0; i < range.count(); ++i) {
        if (i % 16 == 0) report(progress, "load", i, range.count());
        const torch::Tensor sample = tensor_of(observation.store->image(range.begin + i));
        samples_[i].copy_(resized(sample.unsqueeze(0), size, size)[0]);
    }
    report(progress, "load", range.count(), range.count());
}

int learned_size(int width, int height) {
    return (std::max(width, height) + 7) / 8 * 8;
}

std::vector<int> TrainingSet::chosen(int most) const {
    const int taken = most > 0 ? std::min(most, count_) : count_;
    std::vector<int> all;
    for (int i = 0; i < taken; ++i) all.push_back(int(std::int64_t(i) * count_ / taken));
    return all;
}

torch::Tensor TrainingSet::windows(const std::vector<int>& indices) const {
    std::vector<torch::Tensor> batch;
    for (const int start : indices) {
        batch.push_back(samples_.slice(0, start, start + (frames_ - 1) * stride_ + 1, stride_));
    }
    return torch::stack(batch);
}

torch::Tensor foreground_mask(const torch::Tensor& windows, int context, const torch::Tensor& tau) {
    const torch::NoGradGuard frozen;
    const torch::Tensor canvas = median_frame(windows.narrow(1, 0, context));
    const torch::Tensor change =
        (windows.narrow(1, context, windows.size(1) - context) - canvas.unsqueeze(1))
            .abs()
            .mean(2, true)
            .amax(1, true);
    return (change > tau.view({-1, 1, 1, 1, 1})).to(torch::kFloat32);
}

WindowErrors window_errors_of(const torch::Tensor& predicted, const torch::Tensor& truth,
                              const torch::Tensor& mask, int least) {
    const torch::Tensor squared = (predicted - truth).pow(2).mean(2, true);  // [B, h, 1, H, W]
    const torch::Tensor pixels = mask.sum({1, 2, 3, 4});
    WindowErrors errors;
    errors.counted = (pixels >= least).to(torch::kFloat32);
    errors.all = squared.mean({2, 3, 4});
    errors.foreground = (squared * mask).sum({2, 3, 4}) / pixels.clamp_min(1).unsqueeze(1) *
                        errors.counted.unsqueeze(1);
    return errors;
}

torch::Tensor window_loss(const WindowErrors& errors, const torch::Tensor& horizon_weights,
                          double scale) {
    const torch::Tensor foreground =
        (errors.foreground * horizon_weights).sum(1).sum() / errors.counted.sum().clamp_min(1);
    const torch::Tensor all = (errors.all * horizon_weights).sum(1).mean();
    return (foreground + kAllPixels * all) / scale;
}

}  // namespace verdigris
