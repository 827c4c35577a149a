// SPDX-License-Identifier: MIT
#include "verdigris/forecast/band_split.h"

#include <algorithm>
#include <cmath>

namespace verdigris {

std::vector<int> band_sigmas(int width, int height) {
    std::vector<int> sigmas;
    for (int sigma = 1; sigma <= std::max(width, height) / 16; sigma *= 2) sigmas.push_back(sigma);
    if (sigmas.empty()) sigmas.push_back(1);
    std::reverse(sigmas.begin(), sigmas.end());
    return sigmas;
}

MaskedGaussian::MaskedGaussian(const Mask& inside, int sigma)
    : inside_(inside),
      width_(inside.width()),
      height_(inside.height()),
      cell_(sigma >= 4 ? sigma / 2 : 1),
      columns_((width_ + cell_ - 1) / cell_),
      rows_((height_ + cell_ - 1) / cell_) {
    const double s = double(sigma) / cell_;
    double sum = 0;
    std::vector<double> taps;
    for (int i = 0; i <= int(std::ceil(3 * s)); ++i) {
        taps.push_back(std::exp(-0.5 * (i / s) * (i / s)));
        sum += (i == 0 ? 1 : 2) * taps.back();
    }
    for (const double t : taps) taps_.push_back(float(t / sum));
    Field ones(inside.pixel_count());
    std::transform(inside.pixels().begin(), inside.pixels().end(), ones.begin(),
                   [](std::uint8_t v) { return v ? 1.0f : 0.0f; });
    sums(ones, weight_);
    blur(weight_);
    for (int x = 0; x < width_; ++x) across_.push_back(between(x, columns_));
}

void MaskedGaussian::sums(const Field& field, Field& cells) const {
    if (cell_ == 1) {
        cells = field;
        return;
    }
    cells.assign(std::size_t(columns_) * std::size_t(rows_), 0);
    for (int y = 0; y < height_; ++y) {
        const float* from = field.data() + std::size_t(y) * std::size_t(width_);
        float* to = cells.data() + std::size_t(y / cell_) * std::size_t(columns_);
        for (int column = 0, x = 0; column < columns_; ++column) {
            float sum = 0;
            for (const int end = std::min(x + cell_, width_); x < end; ++x) sum += from[x];
            to[column] += sum;
        }
    }
}

void MaskedGaussian::blur(Field& cells) const {
    const int reach = int(taps_.size()) - 1;
    const auto columns = std::size_t(columns_);
    Field across(cells.size());
    // With zeros on both sides there is nothing to ask at the ends.
    Field padded(columns + 2 * std::size_t(reach), 0);
    const float* middle = padded.data() + reach;
    for (int y = 0; y < rows_; ++y) {
        const float* from = cells.data() + std::size_t(y) * columns;
        std::copy(from, from + columns, padded.begin() + reach);
        float* to = across.data() + std::size_t(y) * columns;
        for (int x = 0; x < columns_; ++x) to[x] = taps_[0] * middle[x];
        for (int i = 1; i <= reach; ++i) {
            const float tap = taps_[std::size_t(i)];
            const float *left = middle - i, *right = middle + i;
            for (int x = 0; x < columns_; ++x) to[x] += tap * (left[x] + right[x]);
        }
    }
    const Field nothing(columns, 0);
    const auto line = [&](int y) {
        return y < 0 || y >= rows_ ? nothing.data() : across.data() + std::size_t(y) * columns;
    };
    for (int y = 0; y < rows_; ++y) {
        float* to = cells.data() + std::size_t(y) * columns;
        const float* center = line(y);
        for (int x = 0; x < columns_; ++x) to[x] = taps_[0] * center[x];
        for (int i = 1; i <= reach; ++i) {
            const float tap = taps_[std::size_t(i)];
            const float *above = line(y - i), *below = line(y + i);
            for (int x = 0; x < columns_; ++x) to[x] += tap * (above[x] + below[x]);
        }
    }
}

void MaskedGaussian::cells(const Field& field, Field& cells) const {
    sums(field, cells);
    blur(cells);
    for (std::size_t i = 0; i < cells.size(); ++i)
        cells[i] = weight_[i] > 1e-6f ? cells[i] / weight_[i] : 0;
}

// Between the centers of cells.
MaskedGaussian::Between MaskedGaussian::between(int at, int count) const {
    const float position = (float(at) + 0.5f) / float(cell_) - 0.5f;
    const int from = std::clamp(int(std::floor(position)), 0, count - 1);
    return {from, std::min(from + 1, count - 1), std::clamp(position - float(from), 0.0f, 1.0f)};
}

void MaskedGaussian::row(const Field& cells, int y, float* out) const {
    const std::uint8_t* inside = inside_.row(y);
    if (cell_ == 1) {
        const float* from = cells.data() + std::size_t(y) * std::size_t(width_);
        for (int x = 0; x < width_; ++x) {
            const float value = from[x];  // read in any case, so that it becomes vectors
            out[x] = inside[x] ? value : 0;
        }
        return;
    }
    const Between down = between(y, rows_);
    const float* above = cells.data() + std::size_t(down.from) * std::size_t(columns_);
    const float* below = cells.data() + std::size_t(down.to) * std::size_t(columns_);
    // First down, so that across there is one row of cells to look at.
    thread_local Field middle;
    middle.resize(std::size_t(columns_));
    for (int i = 0; i < columns_; ++i)
        middle[std::size_t(i)] = above[i] + down.share * (below[i] - above[i]);
    for (int x = 0; x < width_; ++x) {
        const Between& b = across_[std::size_t(x)];
        const float left = middle[std::size_t(b.from)];
        out[x] = left + b.share * (middle[std::size_t(b.to)] - left);
    }
    for (int x = 0; x < width_; ++x) {
        const float value = out[x];
        out[x] = inside[x] ? value : 0;
    }
}

void MaskedGaussian::mean(const Field& field, Field& out) const {
    Field kept;
    cells(field, kept);
    out.resize(field.size());
    for (int y = 0; y < height_; ++y)
        row(kept, y, out.data() + std::size_t(y) * std::size_t(width_));
}

}  // namespace verdigris
