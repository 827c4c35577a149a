// SPDX-License-Identifier: MIT
// How far a color has moved from the canvas. One expression for the recipe and for the maps, so
// that the dead-zone and the change it is held against are the same number at horizon 0.
#if defined(VERDIGRIS_MATERIAL_CHANGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VERDIGRIS_MATERIAL_CHANGE_INL_H_
#undef VERDIGRIS_MATERIAL_CHANGE_INL_H_
#else
#define VERDIGRIS_MATERIAL_CHANGE_INL_H_
#endif

#include "verdigris/forecast/trajectory_row-inl.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {

/// mean_c |x_c - canvas_c|
template <class D>
HWY_INLINE hn::Vec<D> change_of(D d, const RgbOf<D>& x, const RgbOf<D>& canvas) {
    const auto sum = hn::Add(hn::Add(hn::AbsDiff(x.r, canvas.r), hn::AbsDiff(x.g, canvas.g)),
                             hn::AbsDiff(x.b, canvas.b));
    return hn::Mul(sum, hn::Set(d, 1.0f / 3));
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
