// SPDX-License-Identifier: MIT
#include "verdigris/forecast/color_reversal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/slope_moments.h"

namespace verdigris {
namespace {

// Two-sided 5 % points of Student's t for 2, 3, ... degrees of freedom [Student1908].
constexpr std::array<double, 9> kStudent{4.303, 3.182, 2.776, 2.571, 2.447,
                                         2.365, 2.306, 2.262, 2.228};
// chosen: an arm shorter than a quarter of the other is the bend of a curve that levels off.
constexpr double kMinArmShare = 0.25;
// tuned: color_reversal_test.cpp, on pure jitter; at 6 fewer than one series in a hundred
// fires (in fifty at 5 frames).
constexpr double kMinArmsPerJitter = 6;
// chosen: tiles of a sixteenth of the frame; an average over 64 pixels at 128 x 128.
constexpr int kTilesAcross = 16, kMinTile = 4;
constexpr double kMinTileShare = 0.25;  // chosen: of the specimen's area
constexpr double kVisible = 5e-4;       // the floor of tau itself: see observe/

double median(std::vector<double> v) {
    const auto middle = v.begin() + std::ptrdiff_t(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    return *middle;
}

/// Frame-to-frame jitter from second differences, which a line and a parabola leave constant and
/// a sharp turn disturbs only once.
double jitter(std::span<const double> y) {
    std::vector<double> second;
    for (std::size_t i = 2; i < y.size(); ++i) second.push_back(y[i] - 2 * y[i - 1] + y[i - 2]);
    const double middle = median(second);
    for (double& v : second) v = std::abs(v - middle);
    return 1.4826 * median(second) / std::sqrt(6.0);  // Var(1, -2, 1) = 6
}

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

using Series = std::array<std::vector<double>, 3>;

struct Tile {
    Series color;             // per channel, per frame
    std::int64_t pixels = 0;  // that count
};

void accumulate(const Context& context, const Mask& mask, Rect rect, Tile& tile) {
    for (auto& s : tile.color) s.assign(context.frames.size(), 0.0);
    for (std::size_t f = 0; f < context.frames.size(); ++f) {
        for (int y = rect.y; y < rect.y + rect.height; ++y) {
            for (int x = rect.x; x < rect.x + rect.width; ++x) {
                if (mask(x, y) == 0) continue;
                const SrgbF c = context.frames[f](x, y);
                tile.color[0][f] += double(c.r);
                tile.color[1][f] += double(c.g);
                tile.color[2][f] += double(c.b);
                tile.pixels += f == 0;
            }
        }
    }
}

Series mean_of(const Tile& tile) {
    Series mean = tile.color;
    for (auto& s : mean) {
        for (double& v : s) v /= double(tile.pixels);
    }
    return mean;
}

std::vector<Tile> tiles_of(const Context& context, const Mask& mask) {
    const int width = mask.width(), height = mask.height();
    const int side = std::max(kMinTile, std::min(width, height) / kTilesAcross);
    std::vector<Tile> tiles;
    for (int y = 0; y < height; y += side) {
        for (int x = 0; x < width; x += side) {
            Tile tile;
            accumulate(context, mask, {x, y, std::min(side, width - x), std::min(side, height - y)},
                       tile);
            if (tile.pixels > 0) tiles.push_back(std::move(tile));
        }
    }
    return tiles;
}

}  // namespace

std::optional<Turn> find_turn(std::span<const double> y, double min_arm) {
    const int n = int(y.size());
    if (n < 5) return {};
    const auto w1 = polynomial_weights(n, 2, 1), w2 = polynomial_weights(n, 2, 2);
    const double c1 = dot(w1, y), c2 = dot(w2, y);
    if (c2 == 0) return {};
    Turn turn;
    turn.at = -c1 / (2 * c2);
    turn.rises_first = c2 < 0;
    if (turn.at < 0.5 || turn.at > n - 1.5) return {};
    turn.left_arm = std::abs(c2) * turn.at * turn.at;
    turn.right_arm = std::abs(c2) * (n - 1 - turn.at) * (n - 1 - turn.at);

    double mean = 0, residual = 0;
    for (int t = 0; t < n; ++t) mean += (y[std::size_t(t)] - c1 * t - c2 * t * t) / n;
    for (int t = 0; t < n; ++t) {
        const double r = y[std::size_t(t)] - mean - c1 * t - c2 * t * t;
        residual += r * r;
    }
    const std::size_t freedom = std::size_t(n - 3);
    const double error = std::sqrt(residual / double(freedom) * dot(w2, w2));
    const double student = kStudent[std::min(freedom - 2, kStudent.size() - 1)];
    // A parabola turns even where the series only levels off: the series itself must turn too.
    const auto seen = turn.rises_first ? std::max_element(y.begin(), y.end())
                                       : std::min_element(y.begin(), y.end());
    const double observed = std::min(std::abs(*seen - y.front()), std::abs(*seen - y.back()));
    const double shorter = std::min({turn.left_arm, turn.right_arm, observed});
    const double longer = std::max(turn.left_arm, turn.right_arm);
    if (std::abs(c2) <= student * error) return {};
    if (shorter <= min_arm || shorter < kMinArmShare * longer) return {};
    if (shorter <= kMinArmsPerJitter * jitter(y)) return {};
    return turn;
}

std::vector<Reversal> find_reversals(const Context& context) {
    check_context(context);
    if (context.length() < 5) return {};
    const Mask mask = moving_mask(context);
    const std::vector<Tile> tiles = tiles_of(context, mask);
    if (tiles.empty()) return {};
    Tile whole;
    for (auto& s : whole.color) s.assign(context.frames.size(), 0.0);
    for (const Tile& tile : tiles) {
        whole.pixels += tile.pixels;
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t f = 0; f < context.frames.size(); ++f) {
                whole.color[c][f] += tile.color[c][f];
            }
        }
    }
    const Series mean = mean_of(whole);
    const double visible = std::max(context.tau, kVisible);
    // A tile's mean is noisier than tau allows for only if the tile is tiny.
    const auto tile_arm = [&](const Tile& tile) {
        return std::max(visible, 4 * context.sigma / std::sqrt(double(tile.pixels)));
    };

    std::vector<Reversal> found;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::optional<Turn> of_mean = find_turn(mean[c], visible);
        std::array<std::int64_t, 2> area{};  // trough, peak
        std::array<std::vector<Turn>, 2> turns;
        for (const Tile& tile : tiles) {
            const Series series = mean_of(tile);
            if (const auto turn = find_turn(series[c], tile_arm(tile))) {
                area[turn->rises_first] += tile.pixels;
                turns[turn->rises_first].push_back(*turn);
            }
        }
        const bool peak = of_mean ? of_mean->rises_first : area[1] >= area[0];
        const double share = double(area[peak]) / double(whole.pixels);
        if (!of_mean && share < kMinTileShare) continue;
        Reversal reversal{int(c), {}, share};
        if (of_mean) {
            reversal.turn = *of_mean;
        } else {
            auto& list = turns[peak];
            const auto middle = list.begin() + std::ptrdiff_t(list.size() / 2);
            std::nth_element(list.begin(), middle, list.end(),
                             [](const Turn& a, const Turn& b) { return a.at < b.at; });
            reversal.turn = *middle;
        }
        found.push_back(reversal);
    }
    return found;
}

}  // namespace verdigris
