// SPDX-License-Identifier: MIT
#include "verdigris/render/largest_rectangle.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace verdigris {
namespace {

constexpr int kMostCells = 128;
constexpr double kLeastShare = 0.98;

// Where the specimen ends, its bent edge and what of the backdrop the last cells hold are cut off;
// where only the picture ends there is no such rim. chosen: as far as they were seen to reach in
// on simulated specimens.
int rim(int extent) {
    return std::max(1, extent / 100);
}

// Cells cut [0, extent) as evenly as whole pixels allow.
int cut(int i, int cells, int extent) {
    return int(std::int64_t(i) * extent / cells);
}

bool is_full(const Mask& mask, Rect cell) {
    int inside = 0;
    for (int y = cell.y; y < cell.y + cell.height; ++y) {
        for (int x = cell.x; x < cell.x + cell.width; ++x) inside += mask(x, y) != 0;
    }
    return inside >= kLeastShare * cell.width * cell.height;
}

Rect without_rim(Rect r, const Rect& all) {
    const int x = rim(all.width), y = rim(all.height);
    if (r.width <= 4 * x || r.height <= 4 * y) return r;
    const int left = r.x > 0 ? x : 0, right = r.x + r.width < all.width ? x : 0;
    const int top = r.y > 0 ? y : 0, bottom = r.y + r.height < all.height ? y : 0;
    return {r.x + left, r.y + top, r.width - left - right, r.height - top - bottom};
}

}  // namespace

Rect largest_rectangle(const Mask& mask, int width, int height) {
    const Rect all{0, 0, width, height};
    if (mask.empty()) return all;
    const int columns = std::min(width, kMostCells), rows = std::min(height, kMostCells);
    const auto x_of = [&](int i) { return cut(i, columns, width); };
    const auto y_of = [&](int j) { return cut(j, rows, height); };
    // Row by row the height of the full cells above; then, for each column as the lowest, how far
    // it reaches to both sides.
    std::vector<int> above(std::size_t(columns), 0);
    Rect best = all;
    std::int64_t most = 0;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const Rect cell{x_of(i), y_of(j), x_of(i + 1) - x_of(i), y_of(j + 1) - y_of(j)};
            int& h = above[std::size_t(i)];
            h = is_full(mask, cell) ? h + 1 : 0;
        }
        for (int i = 0; i < columns; ++i) {
            const int h = above[std::size_t(i)];
            if (h == 0) continue;
            int left = i, right = i + 1;
            while (left > 0 && above[std::size_t(left - 1)] >= h) --left;
            while (right < columns && above[std::size_t(right)] >= h) ++right;
            const Rect r{x_of(left), y_of(j + 1 - h), x_of(right) - x_of(left),
                         y_of(j + 1) - y_of(j + 1 - h)};
            const std::int64_t area = std::int64_t(r.width) * r.height;
            if (area > most) {
                most = area;
                best = r;
            }
        }
    }
    return most > 0 ? without_rim(best, all) : best;
}

}  // namespace verdigris
