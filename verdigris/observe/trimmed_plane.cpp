// SPDX-License-Identifier: MIT
#include "verdigris/observe/trimmed_plane.h"

#include <algorithm>
#include <cassert>
#include <new>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 32;  // ~60,000 samples: 30 us or so, well above the cost of a task

}  // namespace

template <class T>
TrimmedPlane<T>::TrimmedPlane(int samples_per_row, int rows)
    : n_(samples_per_row), rows_(rows), padded_((std::size_t(samples_per_row) + 63) / 64 * 64) {}

template <class T>
void TrimmedPlane<T>::begin(int k) {
    assert(k >= 0 && k <= kMaxTrim);
    k_ = k;
    count_ = 0;
    // One chunk per row, sum first, so that a row's state is one stretch of memory.
    row_bytes_ = padded_ * (sizeof(Sum) + 2 * std::size_t(k) * sizeof(T));
    const std::size_t bytes = row_bytes_ * std::size_t(rows_);
    if (bytes > capacity_) {
        state_.reset();
        state_.reset(static_cast<std::byte*>(::operator new (bytes, std::align_val_t{64})));
        capacity_ = bytes;
    }
}

template <class T>
TrimRow<T> TrimmedPlane<T>::row(int y) const {
    std::byte* base = state_.get() + std::size_t(y) * row_bytes_;
    TrimRow<T> row;
    row.sum = reinterpret_cast<Sum*>(base);
    row.low = reinterpret_cast<T*>(base + padded_ * sizeof(Sum));
    row.high = row.low + std::size_t(k_) * padded_;
    row.step = padded_;
    row.n = std::size_t(n_);
    row.k = k_;
    return row;
}

template <class T>
void TrimmedPlane<T>::add(const std::vector<PlaneWindow<T>>& windows) {
    if (windows.empty()) return;
    assert(count_ + int(windows.size()) <= kMaxTrimmedCount);
    const bool first = count_ == 0;
    parallel_rows(rows_, kRowsPerRun, [&](RowRun run) {
        std::vector<const T*> rows(windows.size());
        for (int y = run.begin; y < run.end; ++y) {
            for (std::size_t i = 0; i < windows.size(); ++i) rows[i] = windows[i].row(y);
            trim_add(row(y), rows.data(), int(rows.size()), first);
        }
    });
    count_ += int(windows.size());
}

// `store(y, row)` gets each row of means.
template <class T>
template <class Store>
void TrimmedPlane<T>::mean_rows(int drop, double scale, const Store& store) const {
    assert(drop <= k_ && count_ > 2 * drop);
    const float factor = float(scale / (count_ - 2 * drop));
    parallel_rows(rows_, kRowsPerRun, [&](RowRun run) {
        std::vector<float> means(static_cast<std::size_t>(n_));
        float* to = means.data();
        for (int y = run.begin; y < run.end; ++y) {
            const TrimRow<T> state = row(y);
            for (std::size_t x = 0; x < state.n; ++x) to[x] = float(state.sum[x]);
            // The sums of integers stay below 2^24 (80 * 65535 < 2^23), so float is exact here.
            for (int j = 0; j < drop; ++j) {
                const T* low = state.low + std::size_t(j) * state.step;
                const T* high = state.high + std::size_t(j) * state.step;
                for (std::size_t x = 0; x < state.n; ++x) to[x] -= float(low[x]) + float(high[x]);
            }
            for (std::size_t x = 0; x < state.n; ++x) to[x] *= factor;
            store(y, to);
        }
    });
}

template <class T>
void TrimmedPlane<T>::means(int drop, double scale, float* out) const {
    mean_rows(drop, scale, [&](int y, const float* row) {
        std::copy_n(row, n_, out + std::size_t(y) * std::size_t(n_));
    });
}

template <class T>
void TrimmedPlane<T>::means(int drop, double scale, std::uint16_t* out) const {
    mean_rows(drop, scale, [&](int y, const float* row) {
        std::uint16_t* to = out + std::size_t(y) * std::size_t(n_);
        for (int x = 0; x < n_; ++x) to[x] = std::uint16_t(int(std::min(row[x] + 0.5f, 65535.0f)));
    });
}

template class TrimmedPlane<std::uint8_t>;
template class TrimmedPlane<std::uint16_t>;
template class TrimmedPlane<float>;

}  // namespace verdigris
