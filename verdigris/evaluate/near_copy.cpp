// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/near_copy.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "verdigris/color/convert.h"

namespace verdigris {
namespace {

constexpr int kSide = SurfacePrint::kSide, kMoments = SurfacePrint::kMoments;
constexpr int kShared = 32;   // chosen: cells per side of what two recordings share
constexpr int kAround = 2;    // chosen: coarser than 5 cells are light and shape, which many share
constexpr int kShift = 1;     // chosen: cells; where a codec or a scaler puts a pixel may differ
constexpr int kFewest = 150;  // chosen: of fewer cells chance alone makes surfaces alike
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// A square of numbers, NaN where there is nothing.
struct Grid {
    int side = 0;
    std::vector<double> values;
    explicit Grid(int side_)
        : side(side_), values(std::size_t(side_) * std::size_t(side_), kNothing) {}
    std::size_t index(int x, int y) const {
        return std::size_t(y) * std::size_t(side) + std::size_t(x);
    }
    double& at(int x, int y) { return values[index(x, y)]; }
    double at(int x, int y) const {
        return x < 0 || y < 0 || x >= side || y >= side ? kNothing : values[index(x, y)];
    }
};

Grid cells_of(const SurfacePrint& print, int moment) {
    Grid grid(kSide);
    const std::size_t first = grid.values.size() * std::size_t(moment);
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
        const int code = print.cells[first + i];
        if (code != SurfacePrint::kOutside) grid.values[i] = code;
    }
    return grid;
}

/// Linear between the centers of cells; nothing where a neighbor has nothing.
double between(const Grid& grid, double x, double y) {
    if (!(x >= 0 && x <= grid.side && y >= 0 && y <= grid.side)) return kNothing;
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const double u = x - 0.5 - left, v = y - 0.5 - top;
    const int i = int(left), j = int(top);
    return (1 - v) * ((1 - u) * grid.at(i, j) + u * grid.at(i + 1, j)) +
           v * ((1 - u) * grid.at(i, j + 1) + u * grid.at(i + 1, j + 1));
}

/// The part `shared` of the frame on kShared x kShared cells.
Grid resampled(const Grid& cells, const std::array<double, 4>& place,
               const std::array<double, 4>& shared) {
    Grid out(kShared);
    for (int y = 0; y < kShared; ++y) {
        for (int x = 0; x < kShared; ++x) {
            const double u = shared[0] + shared[2] * (x + 0.5) / kShared,
                         v = shared[1] + shared[3] * (y + 0.5) / kShared;
            out.at(x, y) = between(cells, (u - place[0]) / place[2] * kSide,
                                   (v - place[1]) / place[3] * kSide);
        }
    }
    return out;
}

/// Each cell less the mean of those around it; nothing at a border, where the shape would show.
Grid grain(const Grid& cells) {
    Grid out(kShared);
    for (int y = 0; y < kShared; ++y) {
        for (int x = 0; x < kShared; ++x) {
            double sum = 0;
            for (int v = -kAround; v <= kAround; ++v) {
                for (int u = -kAround; u <= kAround; ++u) sum += cells.at(x + u, y + v);
            }
            out.at(x, y) = cells.at(x, y) - sum / ((2 * kAround + 1) * (2 * kAround + 1));
        }
    }
    return out;
}

/// Of a with b moved by (dx, dy).
double correlation(const Grid& a, const Grid& b, int dx, int dy) {
    double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (int y = 0; y < a.side; ++y) {
        for (int x = 0; x < a.side; ++x) {
            const double p = a.at(x, y), q = b.at(x + dx, y + dy);
            if (std::isnan(p + q)) continue;
            ++n;
            sa += p, sb += q, saa += p * p, sbb += q * q, sab += p * q;
        }
    }
    const double va = saa - sa * sa / n, vb = sbb - sb * sb / n;
    return n < kFewest || !(va > 0) || !(vb > 0) ? 0 : (sab - sa * sb / n) / std::sqrt(va * vb);
}

}  // namespace

SurfacePrint surface_print(const Observation& observation, SampleRange usable) {
    SurfacePrint print;
    const int width = observation.width(), height = observation.height();
    if (width < kSide || height < kSide || usable.count() < 1) return print;
    const CropReport& crop = observation.crop;
    if (crop.frame_width > 0 && crop.frame_height > 0) {
        const double fw = crop.frame_width, fh = crop.frame_height;
        print.place = {crop.rect.x / fw, crop.rect.y / fh, crop.rect.width / fw,
                       crop.rect.height / fh};
    }
    const Mask& specimen = observation.specimen;
    for (int m = 0; m < kMoments; ++m) {
        const auto part = std::int64_t(usable.count()) * (2 * m + 1) / (2 * kMoments);
        const Image<SrgbF> image = observation.store->image(usable.begin + int(part));
        std::vector<double> sum(kSide * kSide), inside(kSide * kSide), all(kSide * kSide);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const int row = y * kSide / height, column = x * kSide / width;
                const auto cell = std::size_t(row) * kSide + std::size_t(column);
                ++all[cell];
                if (!specimen.empty() && specimen(x, y) == 0) continue;
                ++inside[cell];
                sum[cell] += double(luma(image(x, y)));
            }
        }
        for (std::size_t i = 0; i < sum.size(); ++i) {
            print.cells.push_back(2 * inside[i] < all[i]
                                      ? SurfacePrint::kOutside
                                      : int(std::lround(1e4 * std::max(0.0, sum[i] / inside[i]))));
        }
    }
    return print;
}

double surface_likeness(const SurfacePrint& a, const SurfacePrint& b) {
    if (a.empty() || b.empty()) return 0;
    std::array<double, 4> shared{};
    for (std::size_t i : {0, 1}) {
        shared[i] = std::max(a.place[i], b.place[i]);
        shared[i + 2] =
            std::min(a.place[i] + a.place[i + 2], b.place[i] + b.place[i + 2]) - shared[i];
        if (!(shared[i + 2] > 0)) return 0;
    }
    std::vector<Grid> of_a, of_b;
    for (int m = 0; m < kMoments; ++m) {
        of_a.push_back(grain(resampled(cells_of(a, m), a.place, shared)));
        of_b.push_back(grain(resampled(cells_of(b, m), b.place, shared)));
    }
    double best = -1;
    for (int dy = -kShift; dy <= kShift; ++dy) {
        for (int dx = -kShift; dx <= kShift; ++dx) {
            double mean = 0;
            for (std::size_t m = 0; m < of_a.size(); ++m) {
                mean += correlation(of_a[m], of_b[m], dx, dy) / kMoments;
            }
            best = std::max(best, mean);
        }
    }
    return best;
}

std::string near_copy_sentence(const std::string& a, const std::string& b, double likeness) {
    return fmt::format(
        "{} and {} show one specimen in one place (their surfaces are alike to {:.2f}, from {:.2f} "
        "on they count as one): near copies of one recording",
        a, b, likeness, kNearCopy);
}

}  // namespace verdigris
