// SPDX-License-Identifier: MIT
#include "verdigris/metrics/flip_pool.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <vector>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: a bin holds one pixel in thousands, so that few are searched, and the bins fit the cache.
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

/// The error at which the running sum of the sorted `errors` first exceeds `goal`, without sorting:
/// quickselect, by sums instead of counts.
double crossing(std::vector<float> errors, double goal) {
    auto begin = errors.begin(), end = errors.end();
    float pivot = 0;
    while (begin != end) {
        pivot = begin[(end - begin) / 2];
        const auto equal = std::partition(begin, end, [&](float e) { return e < pivot; });
        const auto above = std::partition(equal, end, [&](float e) { return e == pivot; });
        const double below = std::accumulate(begin, equal, 0.0);
        if (below > goal) {
            end = equal;
            continue;
        }
        const double here = below + double(pivot) * double(above - equal);
        if (here > goal) break;
        goal -= here;
        begin = above;
    }
    return double(pivot);  // the last looked at, where rounding ate the rest of the sum
}

/// All errors of one bin, in the order of the map.
std::vector<float> errors_in(const Image<float>& map, std::size_t bin) {
    using Some = std::vector<float>;
    const auto parts = map_rows<Some>(map.height(), kRowsPerRun, [&](RowRun run) {
        Some some;
        for (int y = run.begin; y < run.end; ++y) {
            std::copy_if(map.row(y), map.row(y) + map.width(), std::back_inserter(some),
                         [&](float e) { return bin_of(e) == bin; });
        }
        return some;
    });
    Some all;
    for (const Some& some : parts) all.insert(all.end(), some.begin(), some.end());
    return all;
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
        *quartiles[k] = crossing(errors_in(map, bin), goal - before);
    }
}

}  // namespace verdigris
