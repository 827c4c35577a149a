// SPDX-License-Identifier: MIT
// The inner loop of binning: adds one row of several frames to a running sum and to the k smallest
// and k largest values seen, per sample. Highway, with run-time dispatch; bench/observe_clip.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

namespace verdigris {

/// At most this many values are trimmed at each end. chosen: 10 % of 80 groups (bin_accumulator.h);
/// sum, 8 low and 8 high vectors still fit the 32 registers of AVX-512 and ARM.
inline constexpr int kMaxTrim = 8;
/// At most this many values are added to one row state: 80 * 255 fits the 16-bit sums of u8.
inline constexpr int kMaxTrimmedCount = 80;

/// Wide enough for kMaxTrimmedCount values.
template <class T>
struct TrimSum;
template <>
struct TrimSum<std::uint8_t> {
    using type = std::uint16_t;
};
template <>
struct TrimSum<std::uint16_t> {
    using type = std::uint32_t;
};
template <>
struct TrimSum<float> {
    using type = float;
};

/// State of one row of `n` samples. low[j] starts at low + j * step and holds the j-th smallest
/// value, high likewise the j-th largest. Rows are padded: at least n rounded up to 64 elements
/// may be written. 64-byte aligned.
template <class T>
struct TrimRow {
    typename TrimSum<T>::type* sum = nullptr;
    T* low = nullptr;
    T* high = nullptr;
    std::size_t step = 0;
    std::size_t n = 0;
    int k = 0;  ///< 0..kMaxTrim
};

/// Adds `count` rows. With `first`, what the state held before is ignored.
void trim_add(const TrimRow<std::uint8_t>& row, const std::uint8_t* const* rows, int count,
              bool first);
void trim_add(const TrimRow<std::uint16_t>& row, const std::uint16_t* const* rows, int count,
              bool first);
void trim_add(const TrimRow<float>& row, const float* const* rows, int count, bool first);

}  // namespace verdigris
