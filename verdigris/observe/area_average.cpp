// SPDX-License-Identifier: MIT
#include "verdigris/observe/area_average.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// The source pixels [first, first + weights.size()) that make one output pixel along one axis.
struct Taps {
    int first = 0;
    std::vector<float> weights;
};

Taps taps_for(int index, int source, int target) {
    const double scale = double(source) / target;
    Taps taps;
    if (target > source) {  // linear, centers aligned, clamped at the border
        const double at = std::clamp((index + 0.5) * scale - 0.5, 0.0, double(source - 1));
        taps.first = std::min(int(at), source - 1);
        const double fraction = at - taps.first;
        taps.weights = {float(1 - fraction)};
        if (taps.first + 1 < source) taps.weights.push_back(float(fraction));
        return taps;
    }
    const double begin = index * scale, end = std::min((index + 1) * scale, double(source));
    taps.first = std::min(int(begin), source - 1);
    const int last = std::clamp(int(std::ceil(end - 1e-9)), taps.first + 1, source);
    for (int i = taps.first; i < last; ++i) {
        const double covered = std::min(end, i + 1.0) - std::max(begin, double(i));
        taps.weights.push_back(float(std::max(covered, 0.0) / scale));
    }
    return taps;
}

std::vector<Taps> taps_along(int source, int target) {
    std::vector<Taps> all;
    for (int i = 0; i < target; ++i) all.push_back(taps_for(i, source, target));
    return all;
}

}  // namespace

std::pair<int, int> Resampling::source_rows(int begin, int end) const {
    if (source_height == height) return {begin, end};
    const Taps top = taps_for(begin, source_height, height);
    const Taps bottom = taps_for(end - 1, source_height, height);
    return {top.first, bottom.first + int(bottom.weights.size())};
}

Image<SrgbF> resample_rows(const Image<SrgbF>& part, int part_y, const Resampling& r, int begin,
                           int end) {
    Image<SrgbF> out = Image<SrgbF>::for_overwrite(r.width, end - begin);
    if (r.identity()) {
        for (int y = begin; y < end; ++y) {
            std::copy_n(part.row(y - part_y), r.width, out.row(y - begin));
        }
        return out;
    }
    const std::vector<Taps> columns = taps_along(r.source_width, r.width);
    parallel_rows(end - begin, 8, [&](RowRun run) {
        std::vector<float> sum(std::size_t(r.source_width) * 3);
        for (int y = run.begin; y < run.end; ++y) {
            const Taps rows = taps_for(begin + y, r.source_height, r.height);
            std::fill(sum.begin(), sum.end(), 0.0f);
            for (std::size_t j = 0; j < rows.weights.size(); ++j) {
                const float weight = rows.weights[j];
                const float* row = &part.row(rows.first + int(j) - part_y)->r;
                for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * row[i];
            }
            SrgbF* to = out.row(y);
            for (int x = 0; x < r.width; ++x) {
                const Taps& taps = columns[std::size_t(x)];
                SrgbF value;
                const float* from = sum.data() + std::size_t(taps.first) * 3;
                for (const float weight : taps.weights) {
                    value.r += weight * from[0];
                    value.g += weight * from[1];
                    value.b += weight * from[2];
                    from += 3;
                }
                to[x] = value;
            }
        }
    });
    return out;
}

Image<SrgbF> resample(const Image<SrgbF>& image, int width, int height) {
    return resample_rows(image, 0, {image.width(), image.height(), width, height}, 0, height);
}

Mask resample(const Mask& mask, int width, int height) {
    if (mask.same_size(width, height)) return mask.clone();
    Image<SrgbF> gray(mask.width(), mask.height());
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        gray.pixels()[i].r = mask.pixels()[i] == kInside ? 1.0f : 0.0f;
    }
    const Image<SrgbF> mean = resample(gray, width, height);
    Mask out(width, height);
    for (std::size_t i = 0; i < out.pixel_count(); ++i) {
        out.pixels()[i] = mean.pixels()[i].r >= 0.5f ? kInside : std::uint8_t(0);
    }
    return out;
}

std::pair<int, int> size_with_long_side(int width, int height, int side) {
    const double scale = double(side) / std::max(width, height);
    return {std::max(1, int(std::lround(width * scale))),
            std::max(1, int(std::lround(height * scale)))};
}

}  // namespace verdigris
