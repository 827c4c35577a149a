// SPDX-License-Identifier: MIT
#include "verdigris/observe/noise.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// A Gaussian's standard deviation over its median absolute deviation: 1 / Phi^-1(3/4).
constexpr double kSigmaOverMad = 1.4826;
// Var(x1 - 2 x2 + x3) = 6 Var(x).
const double kSecondDifferenceGain = std::sqrt(6.0);
// derived (docs/models/observe.md): the 1 % point of the union over 10 horizons of the channel-mean
// |y - C|, C the median of 5 samples, in units of sigma. The floor is an eighth of an 8-bit step.
constexpr double kTauOverSigma = 2.40, kTauFloor = 5e-4;
// One step of an 8-bit picture in 16-bit codes.
constexpr double kByteStep = 257;

// The median of values rounded to a few levels (8-bit pictures give multiples of 257), as the
// point where a piecewise linear distribution crosses one half. Each level stands for the span
// half-way to its neighbors.
double grouped_median(const std::vector<std::uint64_t>& counts, std::uint64_t total) {
    std::vector<std::pair<double, double>> levels;  // value, count
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) levels.emplace_back(double(i), double(counts[i]));
    }
    const double half = 0.5 * double(total);
    double below = 0, from = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const auto [value, count] = levels[i];
        double to = i + 1 < levels.size() ? 0.5 * (value + levels[i + 1].first) : value + 0.5;
        // Mostly zeros: beside them stand the few that changed, which say nothing about the
        // noise. It is below one rounding step, and that is all that is known.
        if (value == 0) to = std::min(to, 0.5 * kByteStep);
        if (below + count >= half) {
            if (value == 0) return count >= 0.9 * double(total) ? 0.0 : to * half / count;
            return from + (to - from) * (half - below) / count;
        }
        below += count;
        from = to;
    }
    return from;
}

// As is_clipped() in noise.h, on 16-bit codes.
bool is_clipped(SrgbU16 c) {
    constexpr auto kHigh = std::uint16_t(kSaturated * 65535 + 0.5f);
    constexpr auto kLow = std::uint16_t(kBlack * 65535);
    return std::max({c.r, c.g, c.b}) >= kHigh || std::max({c.r, c.g, c.b}) <= kLow;
}

// As u16_from_srgb, in a loop that compilers vectorize.
void pack_row(const float* from, std::uint16_t* to, int n) {
    for (int i = 0; i < n; ++i) {
        const float v = from[i] > 0 ? std::min(from[i], 1.0f) : 0.0f;
        to[i] = std::uint16_t(int(v * 65535.0f + 0.5f));
    }
}

}  // namespace

NoiseMeter::NoiseMeter(int width, int height)
    : width_(width), height_(height), counts_(std::size_t(kCellsAcross * kCellsDown)) {
    for (auto& image : last_) image = Image<SrgbU16>(width, height);
}

int NoiseMeter::cell(int x, int y) const {
    const int cx = int(std::int64_t(x) * kCellsAcross / width_);
    const int cy = int(std::int64_t(y) * kCellsDown / height_);
    return cy * kCellsAcross + cx;
}

void NoiseMeter::add(int index, const Image<SrgbF>& probe) {
    run_ = index == last_index_ + 1 ? run_ + 1 : 1;
    last_index_ = index;
    Image<SrgbU16>& newest = last_[std::size_t(index % 3)];
    const Image<SrgbU16>& middle = last_[std::size_t((index + 2) % 3)];
    const Image<SrgbU16>& oldest = last_[std::size_t((index + 1) % 3)];
    // A row of cells is one task; a cell is written by one task only.
    parallel_rows(kCellsDown, 1, [&](RowRun run) {
        for (int y = 0; y < height_; ++y) {
            if (cell(0, y) / kCellsAcross != run.begin) continue;
            pack_row(&probe.row(y)->r, &newest.row(y)->r, 3 * width_);
            if (run_ >= 3) count_row(y, oldest.row(y), middle.row(y), newest.row(y));
        }
    });
}

void NoiseMeter::count_row(int y, const SrgbU16* oldest, const SrgbU16* middle,
                           const SrgbU16* newest) {
    for (int across = 0; across < kCellsAcross; ++across) {
        const int begin = (across * width_ + kCellsAcross - 1) / kCellsAcross;
        const int end = ((across + 1) * width_ + kCellsAcross - 1) / kCellsAcross;
        if (begin >= end) continue;
        auto& counts = counts_[std::size_t(cell(begin, y))];
        if (counts.empty()) counts.resize(kLevels);
        for (int x = begin; x < end; ++x) {
            if (!inside_.empty() && inside_(x, y) != kInside) continue;
            const SrgbU16 a = oldest[x], b = middle[x], c = newest[x];
            if (is_clipped(a) || is_clipped(b) || is_clipped(c)) continue;
            const auto count = [&](int p, int q, int r) {
                ++counts[std::size_t(std::min(std::abs(p - 2 * q + r), kLevels - 1))];
            };
            count(a.r, b.r, c.r);
            count(a.g, b.g, c.g);
            count(a.b, b.b, c.b);
        }
    }
}

std::optional<double> NoiseMeter::sigma(const Mask& inside) const {
    std::vector<int> pixels(counts_.size()), in(counts_.size());
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            const auto c = std::size_t(cell(x, y));
            ++pixels[c];
            if (inside.empty() || inside(x, y) == kInside) ++in[c];
        }
    }
    const bool exact = inside.empty() || !inside_.empty();
    std::vector<std::uint64_t> counts(kLevels);
    std::uint64_t total = 0;
    for (std::size_t c = 0; c < counts_.size(); ++c) {
        // chosen: three quarters, so that a cell across the edge counts for the specimen only
        // when its median pixel safely belongs to it.
        if (counts_[c].empty() || (!exact && 4 * in[c] < 3 * pixels[c])) continue;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            counts[i] += counts_[c][i];
            total += counts_[c][i];
        }
    }
    if (total == 0) return std::nullopt;
    return kSigmaOverMad * grouped_median(counts, total) / kSecondDifferenceGain / 65535.0;
}

double spatial_sigma(const Image<SrgbF>& image, const Mask& inside) {
    // The mask 1 -2 1 / -2 4 -2 / 1 -2 1 has a squared sum of 36.
    std::vector<float> responses;
    for (int y = 1; y + 1 < image.height(); ++y) {
        for (int x = 1; x + 1 < image.width(); ++x) {
            if (!inside.empty() && inside(x, y) != kInside) continue;
            if (is_clipped(image(x, y))) continue;
            const auto response = [&](float SrgbF::*c) {
                const auto at = [&](int dx, int dy) { return image(x + dx, y + dy).*c; };
                return at(-1, -1) + at(1, -1) + at(-1, 1) + at(1, 1) -
                       2 * (at(0, -1) + at(-1, 0) + at(1, 0) + at(0, 1)) + 4 * at(0, 0);
            };
            for (auto c : {&SrgbF::r, &SrgbF::g, &SrgbF::b}) {
                responses.push_back(std::fabs(response(c)));
            }
        }
    }
    if (responses.empty()) return 0;
    const auto middle = responses.begin() + std::ptrdiff_t(responses.size() / 2);
    std::nth_element(responses.begin(), middle, responses.end());
    return kSigmaOverMad * double(*middle) / 6;
}

Noise noise_from(double sigma, std::optional<double> tau) {
    Noise noise;
    noise.sigma = sigma;
    noise.tau_given = tau.has_value();
    noise.tau = tau.value_or(std::max(kTauOverSigma * sigma, kTauFloor));
    return noise;
}

}  // namespace verdigris
