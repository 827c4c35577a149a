// SPDX-License-Identifier: MIT
// The formula of delta_e2000 (color/delta_e.cpp) without its angles: where that adds, halves and
// takes cosines of hues, unit vectors do the same with a few multiplications.
#include "verdigris/evaluate/delta_e_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/evaluate/delta_e_planes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "hwy/highway.h"

#ifndef VERDIGRIS_DELTA_E_PLANES_ONCE
#define VERDIGRIS_DELTA_E_PLANES_ONCE
namespace verdigris {
namespace {

constexpr int kDegree = 12;
constexpr float kKnee = 0.04045f;  // [IEC61966-2-1]

/// The sRGB curve above its knee as a polynomial in u = (v - center) / half: the first kDegree + 1
/// Chebyshev terms. derived: the curve's singularity at v = -0.055 makes the terms fall by 1.86
/// each, and the first one left out is below 1e-7.
struct CurveSeries {
    std::array<float, kDegree + 1> power{};  ///< of u^k
    static constexpr double kCenter = (1 + 0.04045) / 2, kHalf = (1 - 0.04045) / 2;
    CurveSeries() {
        constexpr int kNodes = 64;
        std::array<double, kDegree + 1> sum{};
        std::array<double, kDegree + 1> before{1}, now{0, 1};  // T0, T1 in powers of u
        for (int k = 0; k <= kDegree; ++k) {
            double c = 0;
            for (int j = 0; j < kNodes; ++j) {
                const double angle = std::numbers::pi * (j + 0.5) / kNodes;
                const double v = kCenter + kHalf * std::cos(angle);
                c += std::pow((v + 0.055) / 1.055, 2.4) * std::cos(k * angle);
            }
            c *= (k == 0 ? 1.0 : 2.0) / kNodes;
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += c * before[i];
            std::array<double, kDegree + 1> next{};  // T(k+2) = 2 u T(k+1) - T(k)
            for (std::size_t i = 0; i < sum.size(); ++i) {
                next[i] = (i > 0 ? 2 * now[i - 1] : 0) - before[i];
            }
            before = now;
            now = next;
        }
        for (std::size_t i = 0; i < sum.size(); ++i) power[i] = float(sum[i]);
    }
};

}  // namespace
}  // namespace verdigris
#endif

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Encoded to linear, as a screen shows it: limited to [0, 1].
template <class D, class V = hn::Vec<D>>
HWY_INLINE V linear_of(D d, V encoded, const float* power) {
    const V v = hn::Min(hn::Max(encoded, hn::Zero(d)), hn::Set(d, 1.0f));
    const V u = hn::Mul(hn::Sub(v, hn::Set(d, float(CurveSeries::kCenter))),
                        hn::Set(d, float(1 / CurveSeries::kHalf)));
    V sum = hn::Set(d, power[kDegree]);
    for (int k = kDegree - 1; k >= 0; --k) sum = hn::MulAdd(sum, u, hn::Set(d, power[k]));
    return hn::IfThenElse(hn::Le(v, hn::Set(d, kKnee)), hn::Mul(v, hn::Set(d, 1 / 12.92f)), sum);
}

/// The curve of Lab [CIE15]: cbrt above (6/29)^3. The root as t * (t^-1/3)^2, t^-1/3 by Newton from
/// a third of the exponent: 3 %, 2e-3, 7e-6, 1e-10.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V lab_curve_of(D d, V t) {
    const hn::RebindToSigned<D> di;
    const V safe = hn::Max(t, hn::Set(d, 1e-4f));
    const V third = hn::Mul(hn::ConvertTo(d, hn::BitCast(di, safe)), hn::Set(d, 1.0f / 3));
    // 4/3 of the bits of 1, less what centers the error of taking the mantissa as its logarithm
    V y = hn::BitCast(d, hn::Sub(hn::Set(di, 0x54a21d2a), hn::ConvertTo(di, third)));
    for (int i = 0; i < 3; ++i) {
        const V y3 = hn::Mul(hn::Mul(y, y), y);
        const V rest = hn::NegMulAdd(safe, y3, hn::Set(d, 4.0f));
        y = hn::Mul(y, hn::Mul(rest, hn::Set(d, 1.0f / 3)));
    }
    const V root = hn::Mul(safe, hn::Mul(y, y));
    constexpr float kDelta = 6.0f / 29;
    const V line = hn::MulAdd(t, hn::Set(d, 1 / (3 * kDelta * kDelta)), hn::Set(d, 4.0f / 29));
    return hn::IfThenElse(hn::Gt(t, hn::Set(d, kDelta * kDelta * kDelta)), root, line);
}

/// In place: r, g, b become L, a, b. `count` is a multiple of the lanes.
void lab_planes(float* r, float* g, float* b, std::size_t count, const float* power) {
    const hn::ScalableTag<float> d;
    // The matrix of [IEC61966-2-1] over the white (0.9505, 1, 1.0890), as in color/convert.cpp.
    constexpr double xw = 0.9505, zw = 1.0890;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto lr = linear_of(d, hn::LoadU(d, r + i), power);
        const auto lg = linear_of(d, hn::LoadU(d, g + i), power);
        const auto lb = linear_of(d, hn::LoadU(d, b + i), power);
        const auto mix = [&](double cr, double cg, double cb) {
            return hn::MulAdd(
                lr, hn::Set(d, float(cr)),
                hn::MulAdd(lg, hn::Set(d, float(cg)), hn::Mul(lb, hn::Set(d, float(cb)))));
        };
        const auto fx = lab_curve_of(d, mix(0.4124 / xw, 0.3576 / xw, 0.1805 / xw));
        const auto fy = lab_curve_of(d, mix(0.2126, 0.7152, 0.0722));
        const auto fz = lab_curve_of(d, mix(0.0193 / zw, 0.1192 / zw, 0.9505 / zw));
        hn::StoreU(hn::MulSub(hn::Set(d, 116.0f), fy, hn::Set(d, 16.0f)), d, r + i);
        hn::StoreU(hn::Mul(hn::Set(d, 500.0f), hn::Sub(fx, fy)), d, g + i);
        hn::StoreU(hn::Mul(hn::Set(d, 200.0f), hn::Sub(fy, fz)), d, b + i);
    }
}

/// sqrt(C^7 / (C^7 + 25^7)).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V vividness_of(D d, V chroma) {
    const V c = hn::Mul(chroma, hn::Set(d, 1.0f / 25)), c2 = hn::Mul(c, c);
    const V c7 = hn::Mul(hn::Mul(c2, c2), hn::Mul(c2, c));
    return hn::Sqrt(hn::Div(c7, hn::Add(c7, hn::Set(d, 1.0f))));
}

/// sin(60 degrees * exp(-((hue - 275) / 25)^2)) of the unit vector (c, s). Zero beyond 85 degrees
/// from 275, where the exponential is below 1e-5; that is also where hues pass from 360 to 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V blue_turn(D d, V c, V s) {
    constexpr float kCos = 0.0871557427f, kSin = -0.9961946981f;  // of 275 degrees
    const V along = hn::MulAdd(c, hn::Set(d, kCos), hn::Mul(s, hn::Set(d, kSin)));
    const V across = hn::NegMulAdd(c, hn::Set(d, kSin), hn::Mul(s, hn::Set(d, kCos)));
    const auto near = hn::Gt(along, hn::Set(d, kCos));
    if (hn::AllFalse(d, near)) return hn::Zero(d);
    // The angle by its half, as arctan of at most 0.92 [AbramowitzStegun1964, 4.4.47], to 1e-5.
    const V t = hn::Div(across, hn::Add(hn::Max(along, hn::Zero(d)), hn::Set(d, 1.0f)));
    const V t2 = hn::Mul(t, t);
    V atan = hn::Set(d, 0.0208351f);
    atan = hn::MulAdd(atan, t2, hn::Set(d, -0.0851330f));
    atan = hn::MulAdd(atan, t2, hn::Set(d, 0.1801410f));
    atan = hn::MulAdd(atan, t2, hn::Set(d, -0.3302995f));
    atan = hn::Mul(t, hn::MulAdd(atan, t2, hn::Set(d, 0.9998660f)));
    constexpr float kPer25 = float(2 * 180 / std::numbers::pi / 25);
    const V far = hn::Mul(atan, hn::Set(d, kPer25));
    // exp(-x) = (1 - x/64 + (x/64)^2 / 2 - ...)^64 for x up to 11.6
    const V q = hn::Mul(hn::Mul(far, far), hn::Set(d, -1.0f / 64));
    V e = hn::MulAdd(q, hn::Set(d, 1.0f / 24), hn::Set(d, 1.0f / 6));
    e = hn::MulAdd(e, q, hn::Set(d, 0.5f));
    e = hn::MulAdd(e, q, hn::Set(d, 1.0f));
    e = hn::MulAdd(e, q, hn::Set(d, 1.0f));
    for (int i = 0; i < 6; ++i) e = hn::Mul(e, e);
    const V x = hn::Mul(e, hn::Set(d, float(std::numbers::pi / 3))), x2 = hn::Mul(x, x);
    V sine = hn::Set(d, 1.0f / 362880);
    sine = hn::MulAdd(sine, x2, hn::Set(d, -1.0f / 5040));
    sine = hn::MulAdd(sine, x2, hn::Set(d, 1.0f / 120));
    sine = hn::MulAdd(sine, x2, hn::Set(d, -1.0f / 6));
    sine = hn::Mul(x, hn::MulAdd(sine, x2, hn::Set(d, 1.0f)));
    return hn::IfThenElseZero(near, sine);
}

/// kL = kC = kH = 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V difference(D d, V l1, V a1, V b1, V l2, V a2, V b2) {
    const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f), zero = hn::Zero(d);
    const V tiny = hn::Set(d, 1e-9f);
    const auto length = [&](V x, V y) { return hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y))); };
    const V mean_ab = hn::Mul(half, hn::Add(length(a1, b1), length(a2, b2)));
    const V stretch = hn::MulAdd(half, hn::Sub(one, vividness_of(d, mean_ab)), one);
    a1 = hn::Mul(a1, stretch);
    a2 = hn::Mul(a2, stretch);
    const V c1 = length(a1, b1), c2 = length(a2, b2);
    const V i1 = hn::Div(one, hn::Max(c1, tiny)), i2 = hn::Div(one, hn::Max(c2, tiny));
    const V u1 = hn::Mul(a1, i1), v1 = hn::Mul(b1, i1), u2 = hn::Mul(a2, i2), v2 = hn::Mul(b2, i2);
    // The mean hue: half-way along the short arc. Without chroma a vector is zero and the other
    // one's hue remains.
    const V su = hn::Add(u1, u2), sv = hn::Add(v1, v2), s = length(su, sv);
    const V is = hn::Div(one, hn::Max(s, tiny));
    const V c = hn::Mul(su, is), sn = hn::Mul(sv, is);
    // 2 sqrt(C1 C2) sin(step / 2). Up to 90 degrees from the cross product (of colors that are near
    // each other, by their difference), which keeps its digits for equal hues; beyond from the
    // difference of the unit vectors, which keeps them for opposite ones.
    const V da = hn::Sub(a2, a1), db = hn::Sub(b2, b1);
    const auto near = hn::Lt(hn::Add(hn::Abs(da), hn::Abs(db)), c1);
    const V cross = hn::IfThenElse(near, hn::MulSub(a1, db, hn::Mul(b1, da)),
                                   hn::MulSub(a1, b2, hn::Mul(b1, a2)));
    const V dot = hn::MulAdd(u1, u2, hn::Mul(v1, v2));
    const V root = hn::Sqrt(hn::Mul(c1, c2));
    // Next to gray the cross product is rounding; no sine is above 1, though.
    const V most = hn::Add(root, root);
    const V small = hn::Clamp(hn::Div(hn::Add(cross, cross), hn::Max(hn::Mul(root, s), tiny)),
                              hn::Neg(most), most);
    const V wide = hn::CopySign(hn::Mul(root, length(hn::Sub(u1, u2), hn::Sub(v1, v2))), cross);
    const V dh = hn::IfThenElse(hn::Lt(dot, zero), wide, small);

    const V l = hn::Sub(hn::Mul(half, hn::Add(l1, l2)), hn::Set(d, 50.0f)), ll = hn::Mul(l, l);
    const V chroma = hn::Mul(half, hn::Add(c1, c2));
    const V cos2 = hn::Sub(hn::Mul(hn::Add(c, c), c), one), sin2 = hn::Mul(hn::Add(c, c), sn);
    const V cos3 = hn::Sub(hn::Mul(cos2, c), hn::Mul(sin2, sn));
    const V sin3 = hn::MulAdd(sin2, c, hn::Mul(cos2, sn));
    const V cos4 = hn::Sub(hn::Mul(hn::Add(cos2, cos2), cos2), one);
    const V sin4 = hn::Mul(hn::Add(cos2, cos2), sin2);
    const auto turned = [&](V cosine, V sine, double factor, double degrees) {
        const double r = degrees * std::numbers::pi / 180;
        return hn::MulAdd(cosine, hn::Set(d, float(factor * std::cos(r))),
                          hn::Mul(sine, hn::Set(d, float(factor * std::sin(r)))));
    };
    const V t =
        hn::Add(hn::Add(hn::Sub(one, turned(c, sn, 0.17, 30)), turned(cos3, sin3, 0.32, -6)),
                hn::Sub(hn::Mul(cos2, hn::Set(d, 0.24f)), turned(cos4, sin4, 0.20, 63)));
    const V weight_l =
        hn::MulAdd(hn::Set(d, 0.015f), hn::Div(ll, hn::Sqrt(hn::Add(ll, hn::Set(d, 20.0f)))), one);
    const V weight_c = hn::MulAdd(hn::Set(d, 0.045f), chroma, one);
    const V weight_h = hn::MulAdd(hn::Mul(hn::Set(d, 0.015f), chroma), t, one);
    const V wl = hn::Div(hn::Sub(l2, l1), weight_l), wc = hn::Div(hn::Sub(c2, c1), weight_c),
            wh = hn::Div(dh, weight_h);
    const V turn =
        hn::Mul(hn::Mul(hn::Set(d, -2.0f), blue_turn(d, c, sn)), vividness_of(d, chroma));
    const V squares = hn::MulAdd(wl, wl, hn::MulAdd(wc, wc, hn::Mul(wh, wh)));
    return hn::Sqrt(hn::Max(hn::MulAdd(hn::Mul(turn, wc), wh, squares), zero));
}

/// Of `count` pixels; all arrays may be read up to the next multiple of the lanes.
double sum_difference(const float* const* p, const float* const* q, std::size_t count) {
    const hn::ScalableTag<float> d;
    const hn::ScalableTag<double> dd;
    const hn::Rebind<float, decltype(dd)> half_d;
    auto low = hn::Zero(dd);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        auto e =
            difference(d, hn::LoadU(d, p[0] + i), hn::LoadU(d, p[1] + i), hn::LoadU(d, p[2] + i),
                       hn::LoadU(d, q[0] + i), hn::LoadU(d, q[1] + i), hn::LoadU(d, q[2] + i));
        e = hn::IfThenElseZero(hn::FirstN(d, count - i), e);
        alignas(256) float lanes[hn::MaxLanes(hn::ScalableTag<float>())];
        hn::Store(e, d, lanes);
        for (std::size_t k = 0; k < hn::Lanes(d); k += hn::Lanes(dd)) {
            low = hn::Add(low, hn::PromoteTo(dd, hn::LoadU(half_d, lanes + k)));
        }
    }
    return hn::GetLane(hn::SumOfLanes(dd, low));
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
namespace {

HWY_EXPORT(lab_planes);
HWY_EXPORT(sum_difference);

constexpr std::size_t kPad = 64;  // chosen: no target has more lanes of float

}  // namespace

void lab_of_pixels(const Image<SrgbF>& image, std::span<const std::uint32_t> where,
                   LabPlanes& out) {
    static const CurveSeries series;
    const std::size_t padded = (where.size() + kPad - 1) / kPad * kPad;
    for (auto* plane : {&out.l, &out.a, &out.b}) plane->resize(padded);
    out.count = where.size();
    const auto pixels = image.pixels();
    for (std::size_t i = 0; i < where.size(); ++i) {
        const SrgbF c = pixels[where[i]];
        out.l[i] = c.r;
        out.a[i] = c.g;
        out.b[i] = c.b;
    }
    for (auto* plane : {&out.l, &out.a, &out.b}) {
        std::fill(plane->begin() + std::ptrdiff_t(where.size()), plane->end(), 0.5f);
    }
    HWY_DYNAMIC_DISPATCH(lab_planes)
    (out.l.data(), out.a.data(), out.b.data(), padded, series.power.data());
}

double mean_delta_e2000(const LabPlanes& first, const LabPlanes& second) {
    if (first.count == 0) return 0;
    const float* p[] = {first.l.data(), first.a.data(), first.b.data()};
    const float* q[] = {second.l.data(), second.a.data(), second.b.data()};
    return HWY_DYNAMIC_DISPATCH(sum_difference)(p, q, first.count) / double(first.count);
}

}  // namespace verdigris
#endif  // HWY_ONCE
