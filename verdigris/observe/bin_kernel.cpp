// SPDX-License-Identifier: MIT
#include "verdigris/observe/bin_kernel.h"

// Vectors live in arrays below, which the sizeless types of SVE and RVV do not allow; NEON serves
// those machines.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/observe/bin_kernel.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include <array>
#include <cstring>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// How the sum of a vector of T is kept: integers in two vectors of twice the width (one where a
// vector is one number), float in one.
template <class T>
struct Sums {
    using D = hn::ScalableTag<T>;
    using W = typename TrimSum<T>::type;
#if HWY_TARGET == HWY_SCALAR
    using DW = hn::ScalableTag<W>;
    hn::Vec<DW> all;

    HWY_ATTR void zero() {
        all = hn::Zero(DW());
    }
    HWY_ATTR void load(const W* from) {
        all = hn::Load(DW(), from);
    }
    HWY_ATTR void store(W* to) const {
        hn::Store(all, DW(), to);
    }
    HWY_ATTR void add(hn::Vec<D> v) {
        all = hn::Add(all, hn::PromoteTo(DW(), v));
    }
#else
    using DW = hn::Repartition<W, D>;
    hn::Vec<DW> lower, upper;

    HWY_ATTR void zero() {
        lower = upper = hn::Zero(DW());
    }
    HWY_ATTR void load(const W* from) {
        lower = hn::Load(DW(), from);
        upper = hn::Load(DW(), from + hn::Lanes(DW()));
    }
    HWY_ATTR void store(W* to) const {
        hn::Store(lower, DW(), to);
        hn::Store(upper, DW(), to + hn::Lanes(DW()));
    }
    HWY_ATTR void add(hn::Vec<D> v) {
        const hn::Half<D> half;
        lower = hn::Add(lower, hn::PromoteTo(DW(), hn::LowerHalf(half, v)));
        upper = hn::Add(upper, hn::PromoteTo(DW(), hn::UpperHalf(half, v)));
    }
#endif
};
template <>
struct Sums<float> {
    using D = hn::ScalableTag<float>;
    hn::Vec<D> all;

    HWY_ATTR void zero() { all = hn::Zero(D()); }
    HWY_ATTR void load(const float* from) { all = hn::Load(D(), from); }
    HWY_ATTR void store(float* to) const { hn::Store(all, D(), to); }
    HWY_ATTR void add(hn::Vec<D> v) { all = hn::Add(all, v); }
};

template <class T, int K>
HWY_ATTR void add_rows(const TrimRow<T>& row, const T* const* rows, int count, bool first) {
    using D = hn::ScalableTag<T>;
    const D d;
    const std::size_t lanes = hn::Lanes(d);
    constexpr std::size_t kSlots = K > 0 ? K : 1;  // NOLINT(bugprone-branch-clone): not for K = 1
    HWY_ALIGN std::array<T, 64> tail{};
    for (std::size_t x = 0; x < row.n; x += lanes) {
        Sums<T> sums;
        std::array<hn::Vec<D>, kSlots> low, high;
        if (first) {
            sums.zero();
            for (int j = 0; j < K; ++j) {
                low[std::size_t(j)] = hn::Set(d, std::numeric_limits<T>::max());
                high[std::size_t(j)] = hn::Set(d, std::numeric_limits<T>::lowest());
            }
        } else {
            sums.load(row.sum + x);
            for (int j = 0; j < K; ++j) {
                low[std::size_t(j)] = hn::Load(d, row.low + std::size_t(j) * row.step + x);
                high[std::size_t(j)] = hn::Load(d, row.high + std::size_t(j) * row.step + x);
            }
        }
        const bool whole = x + lanes <= row.n;
        for (int i = 0; i < count; ++i) {
            hn::Vec<D> v;
            if (whole) {
                v = hn::LoadU(d, rows[i] + x);
            } else {  // never read behind the row: the last one may end with the memory
                std::memcpy(tail.data(), rows[i] + x, (row.n - x) * sizeof(T));
                v = hn::Load(d, tail.data());
            }
            sums.add(v);
            // Insertion into two sorted lists: what is displaced moves on to the next place.
            hn::Vec<D> small = v, large = v;
            for (int j = 0; j < K; ++j) {
                const hn::Vec<D> l = low[std::size_t(j)], h = high[std::size_t(j)];
                low[std::size_t(j)] = hn::Min(l, small);
                small = hn::Max(l, small);
                high[std::size_t(j)] = hn::Max(h, large);
                large = hn::Min(h, large);
            }
        }
        sums.store(row.sum + x);
        for (int j = 0; j < K; ++j) {
            hn::Store(low[std::size_t(j)], d, row.low + std::size_t(j) * row.step + x);
            hn::Store(high[std::size_t(j)], d, row.high + std::size_t(j) * row.step + x);
        }
    }
}

template <class T>
HWY_ATTR void add_rows_for_k(const TrimRow<T>& row, const T* const* rows, int count, bool first) {
    static_assert(kMaxTrim == 8);
    switch (row.k) {
        case 0:
            return add_rows<T, 0>(row, rows, count, first);
        case 1:
            return add_rows<T, 1>(row, rows, count, first);
        case 2:
            return add_rows<T, 2>(row, rows, count, first);
        case 3:
            return add_rows<T, 3>(row, rows, count, first);
        case 4:
            return add_rows<T, 4>(row, rows, count, first);
        case 5:
            return add_rows<T, 5>(row, rows, count, first);
        case 6:
            return add_rows<T, 6>(row, rows, count, first);
        case 7:
            return add_rows<T, 7>(row, rows, count, first);
        default:
            return add_rows<T, 8>(row, rows, count, first);
    }
}

HWY_ATTR void add_u8(const TrimRow<std::uint8_t>& row, const std::uint8_t* const* rows, int count,
                     bool first) {
    add_rows_for_k(row, rows, count, first);
}
HWY_ATTR void add_u16(const TrimRow<std::uint16_t>& row, const std::uint16_t* const* rows,
                      int count, bool first) {
    add_rows_for_k(row, rows, count, first);
}
HWY_ATTR void add_f32(const TrimRow<float>& row, const float* const* rows, int count, bool first) {
    add_rows_for_k(row, rows, count, first);
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {

HWY_EXPORT(add_u8);
HWY_EXPORT(add_u16);
HWY_EXPORT(add_f32);

void trim_add(const TrimRow<std::uint8_t>& row, const std::uint8_t* const* rows, int count,
              bool first) {
    HWY_DYNAMIC_DISPATCH(add_u8)(row, rows, count, first);
}
void trim_add(const TrimRow<std::uint16_t>& row, const std::uint16_t* const* rows, int count,
              bool first) {
    HWY_DYNAMIC_DISPATCH(add_u16)(row, rows, count, first);
}
void trim_add(const TrimRow<float>& row, const float* const* rows, int count, bool first) {
    HWY_DYNAMIC_DISPATCH(add_f32)(row, rows, count, first);
}

}  // namespace verdigris
#endif
