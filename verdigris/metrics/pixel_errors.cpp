// SPDX-License-Identifier: MIT
#include "verdigris/metrics/pixel_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/color/delta_e.h"
#include "verdigris/metrics/image_pair.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 16;

double square(double v) {
    return v * v;
}

Lab lab_of(SrgbF c) {
    return lab_from_srgb({float(limited(c.r)), float(limited(c.g)), float(limited(c.b))});
}

double sum_in_order(const std::vector<double>& partials) {
    return std::accumulate(partials.begin(), partials.end(), 0.0);
}

}  // namespace

double mean_squared_error(ImageView<const SrgbF> reference, ImageView<const SrgbF> test) {
    check_pair(reference, test);
    const auto partials = map_rows<double>(reference.height(), kRowsPerRun, [&](RowRun run) {
        double sum = 0;
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < reference.width(); ++x) {
                const SrgbF a = reference(x, y), b = test(x, y);
                sum += square(limited(a.r) - limited(b.r)) + square(limited(a.g) - limited(b.g)) +
                       square(limited(a.b) - limited(b.b));
            }
        }
        return sum;
    });
    return sum_in_order(partials) / (3 * double(reference.pixel_count()));
}

double psnr_of(double mean_squared_error) {
    if (mean_squared_error == 0) return std::numeric_limits<double>::infinity();
    return -10 * std::log10(mean_squared_error);
}

ColorDifference color_difference(ImageView<const SrgbF> reference, ImageView<const SrgbF> test) {
    check_pair(reference, test);
    const std::size_t width = std::size_t(reference.width());
    std::vector<float> all(reference.pixel_count());
    const auto partials = map_rows<double>(reference.height(), kRowsPerRun, [&](RowRun run) {
        double sum = 0;
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < reference.width(); ++x) {
                const double e = delta_e2000(lab_of(reference(x, y)), lab_of(test(x, y)));
                all[std::size_t(y) * width + std::size_t(x)] = float(e);
                sum += e;
            }
        }
        return sum;
    });
    ColorDifference out;
    out.mean = sum_in_order(partials) / double(all.size());
    // The nearest rank, counted in whole numbers.
    const std::size_t rank = (all.size() * 95 + 99) / 100;
    const auto at = all.begin() + std::ptrdiff_t(rank - 1);
    std::nth_element(all.begin(), at, all.end());
    out.percentile95 = double(*at);
    return out;
}

}  // namespace verdigris
