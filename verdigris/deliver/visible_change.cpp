// SPDX-License-Identifier: MIT
#include "verdigris/deliver/visible_change.h"

#include <algorithm>
#include <cmath>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: a run of about 30 us at 256 pixels a row.
constexpr int kRowsPerRun = 32;
// chosen: one glint in 200 pixels may saturate the scale, not set it.
constexpr double kPercentile = 0.995;
// chosen: below 1 % of full scale a change is hardly visible on a screen.
constexpr double kSmallestScale = 0.01;

bool inside(const Mask& where, std::size_t i) {
    return where.empty() || where.pixels()[i] != 0;
}

}  // namespace

Image<float> change_between(const Image<SrgbF>& base, const Image<SrgbF>& frame) {
    Image<float> map = Image<float>::for_overwrite(base.width(), base.height());
    parallel_rows(base.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            std::transform(
                base.row(y), base.row(y) + base.width(), frame.row(y), map.row(y),
                [](SrgbF a, SrgbF b) {
                    return (std::abs(b.r - a.r) + std::abs(b.g - a.g) + std::abs(b.b - a.b)) / 3.0f;
                });
        }
    });
    return map;
}

double mean_inside(const Image<float>& map, const Mask& where) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < map.pixel_count(); ++i) {
        if (!inside(where, i)) continue;
        sum += double(map.pixels()[i]);
        ++count;
    }
    return count > 0 ? sum / double(count) : 0;
}

double round_scale(double largest) {
    for (double decade : {0.01, 0.1, 1.0}) {
        for (double step : {0.1, 0.2, 0.5, 1.0}) {
            const double end = decade * step;
            if (end >= kSmallestScale && end >= largest) return end;
        }
    }
    return 1;
}

double change_scale(const std::vector<Image<float>>& maps, const Mask& where) {
    double largest = 0;
    for (const Image<float>& map : maps) {
        std::vector<float> values;
        values.reserve(map.pixel_count());
        for (std::size_t i = 0; i < map.pixel_count(); ++i) {
            if (inside(where, i)) values.push_back(map.pixels()[i]);
        }
        if (values.empty()) continue;
        const auto nth = values.begin() + std::ptrdiff_t(kPercentile * double(values.size() - 1));
        std::nth_element(values.begin(), nth, values.end());
        largest = std::max(largest, double(*nth));
    }
    return round_scale(largest);
}

}  // namespace verdigris
