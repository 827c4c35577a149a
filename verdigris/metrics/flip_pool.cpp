// SPDX-License-Identifier: MIT
#include "verdigris/metrics/flip_pool.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: a bin holds one pixel in thousands, so that few are sorted, and the bins fit the cache.
constexpr int kBins = 2048;
constexpr int kRowsPerRun = 64;

std::size_t bin_of(float error) {
    return std::size_t(std::min(int(error * kBins), kBins - 1));
}

struct Partial {
    double sum = 0;
    float minimum = 2, maximum = -1;
    std::vector<double> in_bin;  ///< sum of errors
};

/// The error at which the running sum of the sorted errors of `bin`, which starts at `before`,
/// first exceeds `goal`.
double crossing(const Image<float>& map, std::size_t bin, double before, double goal) {
    std::vector<float> errors;
    for (const float e : map.pixels()) {
        if (bin_of(e) == bin) errors.push_back(e);
    }
    std::sort(errors.begin(), errors.end());
    for (const float e : errors) {
        before += double(e);
        if (before > goal) return double(e);
    }
    return errors.empty() ? 0 : double(errors.back());  // rounding ate the last one
}

}  // namespace

void pool_errors(FlipResult& result) {
    const Image<float>& map = result.map;
    const std::vector<Partial> partials =
        map_rows<Partial>(map.height(), kRowsPerRun, [&](RowRun run) {
            Partial p;
            p.in_bin.resize(kBins);
            for (int y = run.begin; y < run.end; ++y) {
                for (int x = 0; x < map.width(); ++x) {
                    const float e = map.row(y)[x];
                    p.minimum = std::min(p.minimum, e);
                    p.maximum = std::max(p.maximum, e);
                    p.in_bin[bin_of(e)] += double(e);
                }
            }
            return p;
        });
    Partial all;
    all.in_bin.resize(kBins);
    for (const Partial& p : partials) {
        all.minimum = std::min(all.minimum, p.minimum);
        all.maximum = std::max(all.maximum, p.maximum);
        for (std::size_t i = 0; i < kBins; ++i) all.in_bin[i] += p.in_bin[i];
    }
    for (const double in_bin : all.in_bin) all.sum += in_bin;
    result.mean = all.sum / double(map.pixel_count());
    result.minimum = double(all.minimum);
    result.maximum = double(all.maximum);
    const std::array<double*, 3> quartiles{&result.first_quartile, &result.median,
                                           &result.third_quartile};
    for (std::size_t k = 0; k < quartiles.size(); ++k) {
        *quartiles[k] = 0;
        if (all.sum == 0) continue;
        const double goal = all.sum * double(k + 1) / 4;
        double before = 0;
        std::size_t bin = 0;
        while (bin + 1 < kBins && before + all.in_bin[bin] <= goal) before += all.in_bin[bin++];
        *quartiles[k] = crossing(map, bin, before, goal);
    }
}

}  // namespace verdigris
