// SPDX-License-Identifier: MIT
// A plane of trimmed means under construction, for one sample type.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "verdigris/observe/bin_kernel.h"

namespace verdigris {

/// One row-major window of a frame's plane: `data` is its first sample.
template <class T>
struct PlaneWindow {
    const T* data = nullptr;
    std::ptrdiff_t stride_bytes = 0;
    const T* row(int y) const {
        return reinterpret_cast<const T*>(reinterpret_cast<const std::byte*>(data) +
                                          y * stride_bytes);
    }
};

/// Running sum, k smallest and k largest of every sample. Memory: (size of the sum + 2 k) per
/// sample, however many frames are added.
template <class T>
class TrimmedPlane {
  public:
    TrimmedPlane(int samples_per_row, int rows);

    /// Forgets what was added. k <= kMaxTrim.
    void begin(int k);
    /// At most kMaxTrimmedCount in all. Rows in parallel.
    void add(const std::vector<PlaneWindow<T>>& windows);
    int count() const { return count_; }
    /// The mean of what is left after dropping the `drop` <= k smallest and largest, times
    /// `scale`. `out` holds rows x samples_per_row, contiguous. Needs count() > 2 * drop.
    void means(int drop, double scale, float* out) const;
    /// The same, rounded to 16 bits and limited to what they hold.
    void means(int drop, double scale, std::uint16_t* out) const;

  private:
    template <class Store>
    void mean_rows(int drop, double scale, const Store& store) const;
    using Sum = typename TrimSum<T>::type;
    TrimRow<T> row(int y) const;

    struct Release {
        void operator()(std::byte* p) const { ::operator delete (p, std::align_val_t{64}); }
    };
    int n_ = 0, rows_ = 0, k_ = 0, count_ = 0;
    std::size_t padded_ = 0, row_bytes_ = 0, capacity_ = 0;
    std::unique_ptr<std::byte, Release> state_;
};

extern template class TrimmedPlane<std::uint8_t>;
extern template class TrimmedPlane<std::uint16_t>;
extern template class TrimmedPlane<float>;

}  // namespace verdigris
