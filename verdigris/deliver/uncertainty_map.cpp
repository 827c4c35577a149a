// SPDX-License-Identifier: MIT
#include "verdigris/deliver/uncertainty_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verdigris/color/magma.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 32;  // chosen: a run of about 30 us at 256 pixels a row
// chosen: a coarse pixel is what at least half of its area is, as for the recipe's images.
constexpr float kMajority = 0.5f;
// chosen: as for maps of change, one pixel in 200 may saturate the scale, not set it.
constexpr double kPercentile = 0.995;

/// Half width of a pixel with this share; the law is that of spread_image().
struct Width {
    double common = 0, own = 0;
    Width(const Spread& spread, double horizon) {
        if (!(horizon > 0)) return;
        const SpreadNode node = spread.at(horizon);
        const SrgbF c = spread.common;
        common = node.common * (double(c.r) + double(c.g) + double(c.b)) / 3;
        own = node.own;
    }
    float operator()(float share) const {
        return share > 0 ? float(kHalfWidth80 * std::sqrt(common + own * double(share))) : 0.0f;
    }
};

// chosen: what is far off beyond the trust limit must not leave the next five units in the dark,
// where nobody sees which part of the specimen is less sure.
constexpr double kLargestGrowth = 4;

double round_codes(double codes) {
    for (double decade : {1.0, 10.0, 100.0}) {
        for (double step : {1.0, 1.2, 1.6, 2.0, 2.4, 3.0, 4.0, 5.0, 6.0, 8.0}) {
            // A width is a float: what rounds to 8 needs no 10.
            if (decade * step >= codes * (1 - 1e-6)) return decade * step;
        }
    }
    return 1000;
}

}  // namespace

Image<float> own_share(const Spread& spread, PictureSize extent) {
    const Image<SrgbF>& own = spread.own;
    if (own.empty()) return Image<float>(extent.width, extent.height);
    auto share = Image<float>::for_overwrite(own.width(), own.height());
    auto weight = Image<float>::for_overwrite(own.width(), own.height());
    parallel_rows(own.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            std::transform(own.row(y), own.row(y) + own.width(), share.row(y),
                           [](SrgbF c) { return (c.r + c.g + c.b) / 3; });
            std::transform(share.row(y), share.row(y) + own.width(), weight.row(y),
                           [](float v) { return v > 0 ? 1.0f : 0.0f; });
        }
    });
    if (extent == PictureSize{own.width(), own.height()}) return share;
    // The average over what moves is average(share) / average(weight): what is held has no share.
    Image<float> result = resampled(share, extent);
    const Image<float> moves = resampled(weight, extent);
    for (std::size_t i = 0; i < result.pixel_count(); ++i) {
        float& v = result.pixels()[i];
        v = moves.pixels()[i] >= kMajority ? v / moves.pixels()[i] : 0.0f;
    }
    return result;
}

Image<float> half_width_map(const Spread& spread, const Image<float>& share, double horizon) {
    const Width width(spread, horizon);
    auto map = Image<float>::for_overwrite(share.width(), share.height());
    parallel_rows(map.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            std::transform(share.row(y), share.row(y) + map.width(), map.row(y), width);
        }
    });
    return map;
}

double uncertainty_full_codes(const Delivery& delivery) {
    const Spread& spread = delivery.forecast->spread;
    if (!spread.known()) return 0;
    // Widths grow with the share: the percentile of the one is the other's.
    std::vector<float> shares;
    shares.reserve(spread.own.pixel_count());
    for (const SrgbF& c : spread.own.pixels()) {
        if (const float share = (c.r + c.g + c.b) / 3; share > 0) shares.push_back(share);
    }
    if (shares.empty()) return 1;
    const auto nth = shares.begin() + std::ptrdiff_t(kPercentile * double(shares.size() - 1));
    std::nth_element(shares.begin(), nth, shares.end());
    const double trusted = trusted_horizon(delivery);
    double first = 0, largest = 0;
    for (const double h : delivery.horizons) {
        double width = double(Width(spread, h)(*nth));
        if (first == 0) first = width;
        if (h > trusted) width = std::min(width, kLargestGrowth * first);
        largest = std::max(largest, width);
    }
    return round_codes(255 * largest);
}

Image<SrgbU8> uncertainty_picture(const Image<float>& half_widths, const Image<float>& share,
                                  double full) {
    Image<SrgbU8> picture = magma(half_widths, full);
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
        if (!(share.pixels()[i] > 0)) picture.pixels()[i] = kHeldGray;
    }
    return picture;
}

}  // namespace verdigris
