// SPDX-License-Identifier: MIT
// The pointwise mathematics of FLIP for vectors of pixels. Relative errors below 1e-6 wherever a
// root follows: small differences of dark colors are lifted by powers of 0.7 and 0.5.
#if defined(VERDIGRIS_METRICS_FLIP_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VERDIGRIS_METRICS_FLIP_MATH_INL_H_
#undef VERDIGRIS_METRICS_FLIP_MATH_INL_H_
#else
#define VERDIGRIS_METRICS_FLIP_MATH_INL_H_
#endif

#include <array>
#include <cmath>
#include <cstdint>

#include "verdigris/color/pow-inl.h"
#include "verdigris/metrics/flip_color.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {

template <class D>
struct Three {
    hn::Vec<D> x, y, z;
};

/// Interleaved pixels to planes; the target without vectors has no such instruction.
template <class D>
HWY_INLINE void load_rgb(D d, const float* at, Three<D>& c) {
    if constexpr (hn::MaxLanes(D()) == 1) {
        c.x = hn::Set(d, at[0]), c.y = hn::Set(d, at[1]), c.z = hn::Set(d, at[2]);
    } else {
        hn::LoadInterleaved3(d, at, c.x, c.y, c.z);
    }
}

template <class D>
HWY_INLINE Three<D> product(D d, const std::array<float, 9>& m, const Three<D>& v) {
    const auto row = [&](std::size_t i) HWY_ATTR {
        return hn::MulAdd(
            v.x, hn::Set(d, m[i]),
            hn::MulAdd(v.y, hn::Set(d, m[i + 1]), hn::Mul(v.z, hn::Set(d, m[i + 2]))));
    };
    return {row(0), row(3), row(6)};
}

/// x^(-1/N) of a positive normal number, N = 3 or 5. The bits of a float, taken as a whole number,
/// are nearly its logarithm: a share of them is a guess to 5 %. Each step of Newton's squares the
/// error and multiplies it by (N + 1) / 2: 8e-3, 2e-4, 1e-7 for N = 5.
template <int N, class D, class V = hn::Vec<D>>
HWY_INLINE V inverse_root(D d, V x) {
    static_assert(N == 3 || N == 5);
    const hn::RebindToSigned<D> di;
    // Exponent bias and, below it, what centers the error of the guess [Lomont2003].
    constexpr double kOne = (127 - 0.0450466) * 0x1p23;
    const V bits = hn::ConvertTo(d, hn::BitCast(di, x));
    const V guess = hn::MulAdd(bits, hn::Set(d, -1.0f / N), hn::Set(d, float(kOne + kOne / N)));
    V y = hn::BitCast(d, hn::ConvertTo(di, guess));
    const V part = hn::Mul(x, hn::Set(d, 1.0f / N));
    for (int i = 0; i < 3; ++i) {
        const V y2 = hn::Mul(y, y);
        const V yn = N == 3 ? y2 : hn::Mul(y2, y2);
        const V rest = hn::NegMulAdd(hn::Mul(part, y), yn, hn::Set(d, 1 + 1.0f / N));
        y = hn::Mul(y, rest);
    }
    return y;
}

/// The curve of [IEC61966-2-1] on [0, 1]; what is outside is limited first, NaN is 0.
/// u^2.4 as (u * u^(-1/5))^3.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V linear_of(D d, V encoded) {
    const V v =
        hn::IfThenElseZero(hn::Gt(encoded, hn::Zero(d)), hn::Min(encoded, hn::Set(d, 1.0f)));
    const V u = hn::MulAdd(v, hn::Set(d, 1 / 1.055f), hn::Set(d, 0.055f / 1.055f));
    const V root = hn::Mul(u, inverse_root<5>(d, u));
    const V power = hn::Mul(hn::Mul(root, root), root);
    return hn::IfThenElse(hn::Gt(v, hn::Set(d, 0.04045f)), power,
                          hn::Mul(v, hn::Set(d, 1 / 12.92f)));
}

/// The curve of Lab [CIE15] for t >= 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V lab_curve(D d, V t) {
    constexpr float kDelta = 6.0f / 29;
    const V y = inverse_root<3>(d, t);
    const V root = hn::Mul(t, hn::Mul(y, y));
    const V line = hn::MulAdd(t, hn::Set(d, 1 / (3 * kDelta * kDelta)), hn::Set(d, 4.0f / 29));
    return hn::IfThenElse(hn::Gt(t, hn::Set(d, kDelta * kDelta * kDelta)), root, line);
}

/// L, a, b of a filtered color, a and b scaled by how light it is (Hunt).
template <class D, class V = hn::Vec<D>>
HWY_INLINE Three<D> hunt_lab(D d, const FlipColor& color, const Three<D>& opponent) {
    Three<D> rgb = product(d, color.linear_from_opponent, opponent);
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    rgb = {hn::Min(hn::Max(rgb.x, zero), one), hn::Min(hn::Max(rgb.y, zero), one),
           hn::Min(hn::Max(rgb.z, zero), one)};
    const Three<D> xyz = product(d, color.relative_xyz_from_linear, rgb);
    const V fx = lab_curve(d, xyz.x), fy = lab_curve(d, xyz.y), fz = lab_curve(d, xyz.z);
    const V l = hn::MulSub(hn::Set(d, 116.0f), fy, hn::Set(d, 16.0f));
    return {l, hn::Mul(hn::Mul(hn::Set(d, 5.0f), l), hn::Sub(fx, fy)),
            hn::Mul(hn::Mul(hn::Set(d, 2.0f), l), hn::Sub(fy, fz))};
}

/// |dL| + sqrt(da^2 + db^2).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V hyab(D, const Three<D>& first, const Three<D>& second) {
    const V a = hn::Sub(first.y, second.y), b = hn::Sub(first.z, second.z);
    return hn::Add(hn::AbsDiff(first.x, second.x), hn::Sqrt(hn::MulAdd(a, a, hn::Mul(b, b))));
}

/// The error of a pixel: its color error c, of a distance `hyab`, to the power of one less the
/// feature error sqrt(feature / sqrt(2)). Logarithms of the two powers are added, so that c itself
/// is not needed where it lies on the lower piece, as nearly always.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V flip_error(D d, const FlipColor& color, V distance, V feature) {
    const V log = hn::Mul(hn::Set(d, float(kFlipColorPower)), fast_log2(d, distance));
    V log_error = hn::Add(log, hn::Set(d, std::log2(color.slope)));
    const auto upper = hn::Ge(log, hn::Set(d, std::log2(color.knee)));
    if (!hn::AllFalse(d, upper)) {
        const V above = hn::Sub(fast_exp2(d, log), hn::Set(d, color.knee));
        const V error = hn::MulAdd(above, hn::Set(d, color.upper_slope), hn::Set(d, color.at_knee));
        log_error = hn::IfThenElse(upper, fast_log2(d, error), log_error);
    }
    const V one = hn::Set(d, 1.0f);
    const V feature_error = hn::Sqrt(hn::Mul(feature, hn::Set(d, std::sqrt(0.5f))));
    const V rest = hn::Max(hn::Sub(one, feature_error), hn::Zero(d));
    const V out = hn::Min(fast_exp2(d, hn::Mul(rest, log_error)), one);
    return hn::IfThenElseZero(hn::Gt(distance, hn::Zero(d)), out);
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
