// SPDX-License-Identifier: MIT
// frame(h) of a trajectory for a vector of pixels: shared by evaluate_trajectory and by the fused
// kernel of material/. Included once per SIMD target, from sources only.
#if defined(VERDIGRIS_FORECAST_TRAJECTORY_ROW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VERDIGRIS_FORECAST_TRAJECTORY_ROW_INL_H_
#undef VERDIGRIS_FORECAST_TRAJECTORY_ROW_INL_H_
#else
#define VERDIGRIS_FORECAST_TRAJECTORY_ROW_INL_H_
#endif

#include <cstddef>
#include <limits>

#include "hwy/highway.h"
#include "verdigris/forecast/trajectory_row.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
struct RgbOf {
    hn::Vec<D> r, g, b;
};

/// Interleaved pixels to planes and back; a vector of one lane serves the end of a row.
template <class D>
HWY_INLINE RgbOf<D> load_rgb(D d, const float* HWY_RESTRICT at) {
    RgbOf<D> c;
    if constexpr (hn::MaxLanes(D()) == 1) {
        c.r = hn::Set(d, at[0]), c.g = hn::Set(d, at[1]), c.b = hn::Set(d, at[2]);
    } else {
        hn::LoadInterleaved3(d, at, c.r, c.g, c.b);
    }
    return c;
}
template <class D>
HWY_INLINE void store_rgb(D d, const RgbOf<D>& c, float* HWY_RESTRICT at) {
    if constexpr (hn::MaxLanes(D()) == 1) {
        at[0] = hn::GetLane(c.r), at[1] = hn::GetLane(c.g), at[2] = hn::GetLane(c.b);
    } else {
        hn::StoreInterleaved3(c.r, c.g, c.b, d, at);
    }
}

/// The first h >= 0 at which base + h speed leaves [0, 1]; infinity if it never does.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V linear_exit(D d, V base, V speed) {
    const V zero = hn::Zero(d);
    const V room = hn::IfThenElse(hn::Gt(speed, zero), hn::Sub(hn::Set(d, 1.0f), base), base);
    const V exit = hn::Div(hn::Max(room, zero), hn::Abs(speed));
    return hn::IfThenElse(hn::Eq(speed, zero), hn::Set(d, std::numeric_limits<float>::infinity()),
                          exit);
}

/// The first h >= 0 at which b h + a h^2 exceeds room >= 0; infinity if it never does. In the form
/// 2 room / (b + sqrt(b^2 + 4 a room)) where b >= 0, which loses no digits as a goes to 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V quadratic_exit(D d, V a, V b, V room) {
    const V zero = hn::Zero(d), two = hn::Set(d, 2.0f),
            infinity = hn::Set(d, std::numeric_limits<float>::infinity());
    const V discriminant = hn::MulAdd(b, b, hn::Mul(hn::Mul(hn::Set(d, 4.0f), a), room));
    const V root = hn::Sqrt(hn::Max(discriminant, zero));
    const V below = hn::Add(b, root);
    // b >= 0: outward from the start. below == 0 means b == 0 and a room == 0: either it stands
    // still (never leaves) or it starts on the edge and accelerates outward (leaves at once).
    const V at_once = hn::IfThenElse(hn::Gt(a, zero), zero, infinity);
    const V outward = hn::IfThenElse(hn::Gt(below, zero), hn::Div(hn::Mul(two, room), below),
                                     hn::IfThenElse(hn::Gt(room, zero), infinity, at_once));
    // b < 0: inward first; it comes back only if a > 0.
    const V inward =
        hn::IfThenElse(hn::Gt(a, zero), hn::Div(hn::Sub(root, b), hn::Mul(two, a)), infinity);
    return hn::IfThenElse(hn::Lt(discriminant, zero), infinity,
                          hn::IfThenElse(hn::Ge(b, zero), outward, inward));
}

/// The first h >= 0 at which base + h rate + (h^2 + 2 m h) curvature leaves [0, 1].
template <class D, class V = hn::Vec<D>>
HWY_INLINE V channel_exit(D d, V base, V rate, V curvature, V two_m) {
    const V zero = hn::Zero(d), speed = hn::MulAdd(two_m, curvature, rate);
    const V up =
        quadratic_exit(d, curvature, speed, hn::Max(hn::Sub(hn::Set(d, 1.0f), base), zero));
    const V down = quadratic_exit(d, hn::Neg(curvature), hn::Neg(speed), hn::Max(base, zero));
    return hn::Min(up, down);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V keep_in_range(D d, V value, V base) {
    // Rounding alone must not leave [0, 1]; a base that is outside itself may stay where it is.
    return hn::Max(hn::Min(value, hn::Max(hn::Set(d, 1.0f), base)), hn::Min(hn::Zero(d), base));
}

/// frame(h) of the pixels from x on.
template <class D, class V = hn::Vec<D>>
HWY_INLINE RgbOf<D> frame_at(D d, const TrajectoryRow& row, const TrajectoryTime& time,
                             std::size_t x) {
    const RgbOf<D> base = load_rgb(d, row.base + 3 * x);
    if (time.order == 0) return base;
    const RgbOf<D> rate = load_rgb(d, row.rate + 3 * x);
    RgbOf<D> out;
    V h = hn::Set(d, time.horizon);
    if (time.order == 1) {
        if (time.clamp) {
            h = hn::Min(h, hn::Min(linear_exit(d, base.r, rate.r),
                                   hn::Min(linear_exit(d, base.g, rate.g),
                                           linear_exit(d, base.b, rate.b))));
        }
        out.r = hn::MulAdd(h, rate.r, base.r);
        out.g = hn::MulAdd(h, rate.g, base.g);
        out.b = hn::MulAdd(h, rate.b, base.b);
    } else if (time.tabulated) {
        const RgbOf<D> curvature = load_rgb(d, row.curvature + 3 * x);
        const V phi = hn::Set(d, time.phi), phi2 = hn::Set(d, time.phi2);
        const RgbOf<D> change{hn::MulAdd(phi2, curvature.r, hn::Mul(phi, rate.r)),
                              hn::MulAdd(phi2, curvature.g, hn::Mul(phi, rate.g)),
                              hn::MulAdd(phi2, curvature.b, hn::Mul(phi, rate.b))};
        V share = hn::Set(d, 1.0f);
        if (time.clamp) {
            share = hn::Min(share, hn::Min(linear_exit(d, base.r, change.r),
                                           hn::Min(linear_exit(d, base.g, change.g),
                                                   linear_exit(d, base.b, change.b))));
        }
        out.r = hn::MulAdd(share, change.r, base.r);
        out.g = hn::MulAdd(share, change.g, base.g);
        out.b = hn::MulAdd(share, change.b, base.b);
    } else {
        const RgbOf<D> curvature = load_rgb(d, row.curvature + 3 * x);
        const V two_m = hn::Set(d, time.two_m);
        if (time.clamp) {
            h = hn::Min(h, hn::Min(channel_exit(d, base.r, rate.r, curvature.r, two_m),
                                   hn::Min(channel_exit(d, base.g, rate.g, curvature.g, two_m),
                                           channel_exit(d, base.b, rate.b, curvature.b, two_m))));
        }
        const V square = hn::Mul(h, hn::Add(h, two_m));
        out.r = hn::MulAdd(square, curvature.r, hn::MulAdd(h, rate.r, base.r));
        out.g = hn::MulAdd(square, curvature.g, hn::MulAdd(h, rate.g, base.g));
        out.b = hn::MulAdd(square, curvature.b, hn::MulAdd(h, rate.b, base.b));
    }
    if (time.clamp) {
        out.r = keep_in_range(d, out.r, base.r);
        out.g = keep_in_range(d, out.g, base.g);
        out.b = keep_in_range(d, out.b, base.b);
    }
    return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
