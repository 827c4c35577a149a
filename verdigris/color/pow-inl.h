// SPDX-License-Identifier: MIT
// x^e for vectors, through log2 and exp2: relative error below 1e-6 for x in [0, 1] (pow_test.cpp).
#if defined(VERDIGRIS_COLOR_POW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VERDIGRIS_COLOR_POW_INL_H_
#undef VERDIGRIS_COLOR_POW_INL_H_
#else
#define VERDIGRIS_COLOR_POW_INL_H_
#endif

#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// log2 of a positive normal number: exponent, and the series of atanh on a mantissa in
/// [sqrt(1/2), sqrt(2)). derived: the first term left out, t^11 / 11 at t = 0.1716, is 4e-10.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V fast_log2(D d, V x) {
    const hn::RebindToSigned<D> di;
    constexpr std::int32_t kSqrtHalf = 0x3f3504f3;  // bits of sqrt(1/2)
    const auto bits = hn::BitCast(di, x);
    const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, kSqrtHalf)));
    const V mantissa = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
    const V one = hn::Set(d, 1.0f);
    const V t = hn::Div(hn::Sub(mantissa, one), hn::Add(mantissa, one));
    const V t2 = hn::Mul(t, t);
    constexpr float kScale = 2.88539008f;  // 2 / ln 2
    V series = hn::Set(d, kScale / 9);
    series = hn::MulAdd(series, t2, hn::Set(d, kScale / 7));
    series = hn::MulAdd(series, t2, hn::Set(d, kScale / 5));
    series = hn::MulAdd(series, t2, hn::Set(d, kScale / 3));
    series = hn::MulAdd(series, t2, hn::Set(d, kScale));
    return hn::MulAdd(series, t, hn::ConvertTo(d, exponent));
}

/// 2^v for v <= 127; below -126 it stays at 2^-126. Taylor on [-1/2, 1/2]: the first term left out,
/// (ln 2 / 2)^8 / 8!, is 5e-9.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V fast_exp2(D d, V v) {
    const hn::RebindToSigned<D> di;
    v = hn::Max(v, hn::Set(d, -126.0f));
    const auto whole = hn::NearestInt(v);
    const V f = hn::Sub(v, hn::ConvertTo(d, whole));
    V series = hn::Set(d, 1.52527338e-5f);  // (ln 2)^k / k! for k = 7 .. 0
    series = hn::MulAdd(series, f, hn::Set(d, 1.54035304e-4f));
    series = hn::MulAdd(series, f, hn::Set(d, 1.33335581e-3f));
    series = hn::MulAdd(series, f, hn::Set(d, 9.61812911e-3f));
    series = hn::MulAdd(series, f, hn::Set(d, 5.55041087e-2f));
    series = hn::MulAdd(series, f, hn::Set(d, 2.40226507e-1f));
    series = hn::MulAdd(series, f, hn::Set(d, 6.93147181e-1f));
    series = hn::MulAdd(series, f, hn::Set(d, 1.0f));
    const auto scale = hn::ShiftLeft<23>(hn::Add(whole, hn::Set(di, 127)));
    return hn::Mul(series, hn::BitCast(d, scale));
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
