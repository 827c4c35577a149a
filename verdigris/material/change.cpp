// SPDX-License-Identifier: MIT
#include "verdigris/material/change.h"

#include <algorithm>

#include "verdigris/pixels/parallel_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/material/change.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "verdigris/material/change-inl.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {

template <class D>
HWY_INLINE void change_at(D d, const float* frame, const float* canvas, std::size_t x, float* out) {
    hn::StoreU(change_of(d, load_rgb(d, frame + 3 * x), load_rgb(d, canvas + 3 * x)), d, out + x);
}

void change_row(const float* frame, const float* canvas, std::size_t width, float* out) {
    const hn::ScalableTag<float> d;
    const hn::CappedTag<float, 1> one;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t x = 0;
    for (; x + lanes <= width; x += lanes) change_at(d, frame, canvas, x, out);
    for (; x < width; ++x) change_at(one, frame, canvas, x, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
namespace {
HWY_EXPORT(change_row);
}  // namespace

Image<float> change_map(const Image<SrgbF>& frame, const Image<SrgbF>& canvas) {
    Image<float> change = Image<float>::for_overwrite(frame.width(), frame.height());
    const int rows = std::max(1, 65536 / std::max(frame.width(), 1));
    parallel_rows(frame.height(), rows, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            HWY_DYNAMIC_DISPATCH(change_row)
            (reinterpret_cast<const float*>(frame.row(y)),
             reinterpret_cast<const float*>(canvas.row(y)), std::size_t(frame.width()),
             change.row(y));
        }
    });
    return change;
}

}  // namespace verdigris
#endif  // HWY_ONCE
