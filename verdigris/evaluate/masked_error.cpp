// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/masked_error.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/evaluate/masked_error.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "hwy/highway.h"

#ifndef VERDIGRIS_MASKED_ERROR_ONCE
#define VERDIGRIS_MASKED_ERROR_ONCE
namespace verdigris {
namespace {
struct ErrorSums {
    double foreground = 0, specimen = 0, absolute = 0, bias[3]{};
};
// chosen: a float holds the sum of this many squares to 1e-6, and the errors of blocks cancel.
constexpr std::size_t kBlock = 1024;
}  // namespace
}  // namespace verdigris
#endif

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The pixels [begin, end) of one block, by vectors as far as they go.
void add_block(const float* forecast, const float* truth, const float* foreground,
               const float* specimen, std::size_t begin, std::size_t end, ErrorSums& sums) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    V fg = hn::Zero(d), whole = hn::Zero(d), absolute = hn::Zero(d), br = hn::Zero(d),
      bg = hn::Zero(d), bb = hn::Zero(d);
    std::size_t i = begin;
    if constexpr (hn::MaxLanes(hn::ScalableTag<float>()) > 1) {
        for (; i + lanes <= end; i += lanes) {
            V pr, pg, pb, qr, qg, qb;
            hn::LoadInterleaved3(d, forecast + 3 * i, pr, pg, pb);
            hn::LoadInterleaved3(d, truth + 3 * i, qr, qg, qb);
            const V r = hn::Sub(pr, qr), g = hn::Sub(pg, qg), b = hn::Sub(pb, qb);
            const V square = hn::MulAdd(r, r, hn::MulAdd(g, g, hn::Mul(b, b)));
            const V size = hn::Add(hn::Abs(r), hn::Add(hn::Abs(g), hn::Abs(b)));
            const V w = hn::LoadU(d, specimen + i);
            fg = hn::MulAdd(hn::LoadU(d, foreground + i), square, fg);
            whole = hn::MulAdd(w, square, whole);
            absolute = hn::MulAdd(w, size, absolute);
            br = hn::MulAdd(w, r, br);
            bg = hn::MulAdd(w, g, bg);
            bb = hn::MulAdd(w, b, bb);
        }
    }
    const auto total = [&](V v) { return double(hn::GetLane(hn::SumOfLanes(d, v))); };
    sums.foreground += total(fg);
    sums.specimen += total(whole);
    sums.absolute += total(absolute);
    sums.bias[0] += total(br);
    sums.bias[1] += total(bg);
    sums.bias[2] += total(bb);
    for (; i < end; ++i) {  // the rest, in plain double
        double square = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double e = double(forecast[3 * i + c]) - double(truth[3 * i + c]);
            square += e * e;
            sums.absolute += double(specimen[i]) * (e < 0 ? -e : e);
            sums.bias[c] += double(specimen[i]) * e;
        }
        sums.foreground += double(foreground[i]) * square;
        sums.specimen += double(specimen[i]) * square;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
namespace {
HWY_EXPORT(add_block);
}  // namespace

MaskedError masked_error(const Image<SrgbF>& forecast, const Image<SrgbF>& truth,
                         const PixelWeights& foreground, const PixelWeights& specimen) {
    ErrorSums sums;
    const float* p = &forecast.row(0)->r;
    const float* q = &truth.row(0)->r;
    for (std::size_t i = 0; i < truth.pixel_count(); i += kBlock) {
        HWY_DYNAMIC_DISPATCH(add_block)
        (p, q, foreground.weight.data(), specimen.weight.data(), i,
         std::min(i + kBlock, truth.pixel_count()), sums);
    }
    const auto mean = [](double sum, double count) {
        return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
    };
    const double all = double(specimen.count);
    MaskedError error;
    error.foreground = mean(sums.foreground, 3 * double(foreground.count));
    error.specimen = mean(sums.specimen, 3 * all);
    error.absolute = mean(sums.absolute, 3 * all);
    for (std::size_t c = 0; c < 3; ++c) error.bias[c] = mean(sums.bias[c], all);
    return error;
}

}  // namespace verdigris
#endif  // HWY_ONCE
