// SPDX-License-Identifier: MIT
#include "verdigris/simulate/camera_row.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/simulate/camera_row.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
hn::Vec<D> exposed(D d, const CameraRow& row, std::size_t i) {
    const auto before = hn::LoadU(d, row.before + i), after = hn::LoadU(d, row.after + i);
    const auto gain = hn::Mul(hn::LoadU(d, row.gain + i), hn::Set(d, row.band));
    const auto light = hn::Add(before, hn::Mul(hn::Set(d, row.mix), hn::Sub(after, before)));
    const auto v = hn::Mul(light, gain);
    const auto variance =
        hn::Max(hn::Add(hn::Mul(hn::Set(d, row.shot), v), hn::Set(d, row.read)), hn::Zero(d));
    const auto noisy = hn::Add(v, hn::Mul(hn::Sqrt(variance), hn::LoadU(d, row.noise + i)));
    return hn::Min(hn::Max(noisy, hn::Zero(d)), hn::Set(d, 1.0f));
}

// Calls body(d, i) over all samples, the last ones singly: a mask would read beyond the row.
template <class Body>
void each(std::size_t samples, const Body& body) {
    const hn::ScalableTag<float> d;
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= samples; i += hn::Lanes(d)) body(d, i);
    for (const hn::CappedTag<float, 1> one; i < samples; ++i) body(one, i);
}

void Row(const CameraRow& row, float* out) {
    each(row.samples, [&](auto d, std::size_t i) { hn::StoreU(exposed(d, row, i), d, out + i); });
}

void RowLevels(const CameraRow& row, int levels, std::int32_t* out) {
    const float scale = float(levels - 1);
    each(row.samples, [&](auto d, std::size_t i) {
        const auto level =
            hn::Add(hn::Mul(exposed(d, row, i), hn::Set(d, scale)), hn::Set(d, 0.5f));
        const hn::RebindToSigned<decltype(d)> di;
        hn::StoreU(hn::ConvertTo(di, level), di, out + i);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
HWY_EXPORT(Row);
HWY_EXPORT(RowLevels);

void expose_row(const CameraRow& row, float* out) {
    HWY_DYNAMIC_DISPATCH(Row)(row, out);
}
void expose_row_levels(const CameraRow& row, int levels, std::int32_t* out) {
    HWY_DYNAMIC_DISPATCH(RowLevels)(row, levels, out);
}
}  // namespace verdigris
#endif
