// SPDX-License-Identifier: MIT
#include "verdigris/metrics/flip.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "verdigris/error.h"
#include "verdigris/metrics/flip_filters.h"
#include "verdigris/metrics/flip_pool.h"
#include "verdigris/metrics/flip_tile.h"
#include "verdigris/metrics/image_pair.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: the rows that a tile's filters look at (126 of this width at 67 pixels per degree) fit
// the second cache, and what neighbors compute twice is a tenth.
constexpr int kTileWidth = 256, kTileHeight = 256;

/// Where part `i` of `parts` about equal parts of `length` begins.
int cut(int length, int parts, int i) {
    return int(std::int64_t(length) * i / parts);
}

}  // namespace

double pixels_per_degree(double meters, double screen_meters, double screen_pixels) {
    return meters * screen_pixels / screen_meters * std::numbers::pi / 180;
}

FlipResult flip(ImageView<const SrgbF> reference, ImageView<const SrgbF> test,
                const FlipOptions& options) {
    check_pair(reference, test);
    const double ppd = options.pixels_per_degree;
    if (!(ppd >= kFlipSmallestPpd && ppd <= kFlipLargestPpd)) {
        throw Error(ErrorCode::usage,
                    fmt::format("{} pixels per degree: FLIP is computed for {} to {}", ppd,
                                kFlipSmallestPpd, kFlipLargestPpd));
    }
    const FlipFilters filters = flip_filters(ppd);
    const int width = reference.width(), height = reference.height();
    FlipResult result;
    result.map = Image<float>::for_overwrite(width, height);
    const int columns = (width + kTileWidth - 1) / kTileWidth,
              rows = (height + kTileHeight - 1) / kTileHeight;
    parallel_for(columns * rows, [&](int i) {
        const int column = i % columns, row = i / columns;
        const int x = cut(width, columns, column), y = cut(height, rows, row);
        flip_tile(reference, test, filters,
                  {x, y, cut(width, columns, column + 1) - x, cut(height, rows, row + 1) - y},
                  result.map);
    });
    pool_errors(result);
    return result;
}

}  // namespace verdigris
