// SPDX-License-Identifier: MIT
#include "verdigris/learn/validation.h"

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/evaluate/masked_error.h"
#include "verdigris/learn/network_parts.h"
#include "verdigris/learn/tensor_image.h"

namespace verdigris {

ValidationSet::ValidationSet(const EvaluationProtocol& protocol, const TrainingSource& source,
                             const Progress& progress)
    : context_(protocol.context), horizons_(protocol.horizons), stride_(protocol.stride) {
    const Observation& observation = *source.observation;
    const SampleRange& range = source.validation;
    for (int i = range.begin; i < range.end; ++i) {
        if (i % 16 == 0) report(progress, "load", i - range.begin, range.count());
        samples_.push_back(observation.store->image(i));
    }
    report(progress, "load", range.count(), range.count());
    const double tau = foreground_threshold(protocol, observation.noise.sigma);
    all_ = weights_of({}, observation.width(), observation.height());
    std::vector<float> scratch;
    Image<SrgbF> canvas;
    double sum = 0;
    for (int start = 0; start < windows_inside(range, protocol.span()); ++start) {
        std::vector<Image<SrgbF>> context;
        for (int i = 0; i < context_; ++i) context.push_back(frame(start, i).clone());
        std::vector<const Image<SrgbF>*> truths;
        for (int k = 0; k < horizons_; ++k) truths.push_back(&frame(start, context_ + k));
        canvas_of(context, canvas, scratch);
        std::vector<PixelWeights> mask;
        foreground_of(truths, canvas, tau, MaskRule::union_of_horizons, all_, mask);
        if (mask.front().count < protocol.min_foreground) continue;
        for (const Image<SrgbF>* truth : truths)
            sum += masked_error(context.back(), *truth, mask.front(), all_).foreground;
        starts_.push_back(start);
        foreground_.push_back(std::move(mask.front()));
    }
    if (starts_.empty()) {
        throw Error(ErrorCode::bad_input,
                    "nothing changes in the part that would choose the best epoch: no window has "
                    "enough foreground",
                    source.name);
    }
    persistence_ = sum / double(starts_.size()) / horizons_;
}

const Image<SrgbF>& ValidationSet::frame(int start, int i) const {
    return samples_[std::size_t(start + i * stride_)];
}

ValidationErrors ValidationSet::errors(const Network& network, int batch,
                                       const Progress& progress) const {
    const std::vector<int> units = units_to(horizons_);
    network.parts().module->eval();
    double sum = 0;
    for (std::size_t begin = 0; begin < starts_.size(); begin += std::size_t(batch)) {
        report(progress, "validate", std::int64_t(begin), std::int64_t(starts_.size()));
        const std::size_t end = std::min(begin + std::size_t(batch), starts_.size());
        std::vector<torch::Tensor> contexts;
        for (std::size_t w = begin; w < end; ++w) {
            std::vector<torch::Tensor> frames;
            for (int i = 0; i < context_; ++i) frames.push_back(tensor_of(frame(starts_[w], i)));
            contexts.push_back(torch::stack(frames));
        }
        const torch::Tensor out = forecast_frames(network, torch::stack(contexts), units);
        for (std::size_t w = begin; w < end; ++w) {
            for (int k = 0; k < horizons_; ++k) {
                const Image<SrgbF> predicted = image_of(out[std::int64_t(w - begin)][k]);
                sum +=
                    masked_error(predicted, frame(starts_[w], context_ + k), foreground_[w], all_)
                        .foreground;
            }
        }
    }
    return {sum / double(starts_.size()) / horizons_, persistence_};
}

}  // namespace verdigris
