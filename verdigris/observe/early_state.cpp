// SPDX-License-Identifier: MIT
#include "verdigris/observe/early_state.h"

#include <algorithm>
#include <vector>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {

Image<SrgbF> early_state(const Observation& observation, int samples) {
    const int count = std::clamp(samples, 1, observation.store->count());
    std::vector<Image<SrgbF>> frames;
    for (int i = 0; i < count; ++i) frames.push_back(observation.store->image(i));
    Image<SrgbF> median(observation.width(), observation.height());
    parallel_rows(median.height(), 16, [&](RowRun run) {
        std::vector<float> values(frames.size());
        const auto middle = [&](auto channel) {
            for (std::size_t i = 0; i < frames.size(); ++i) values[i] = channel(frames[i]);
            std::sort(values.begin(), values.end());
            return 0.5f * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
        };
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < median.width(); ++x) {
                median(x, y) = {middle([&](const Image<SrgbF>& f) { return f(x, y).r; }),
                                middle([&](const Image<SrgbF>& f) { return f(x, y).g; }),
                                middle([&](const Image<SrgbF>& f) { return f(x, y).b; })};
            }
        }
    });
    return median;
}

}  // namespace verdigris
