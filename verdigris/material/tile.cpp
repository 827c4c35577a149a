// SPDX-License-Identifier: MIT
// One pass over the rows of a tile. Three stages run one behind the other, each as soon as the
// rows it needs are there, so that an image is read once and every map is written once:
//   color   X, coverage, metallic, luma of a row
//   height  Gaussian of luma, blended with coverage     (needs height_radius rows of luma below)
//   surface micro-roughness, Sobel, normal of a row     (needs `reach` rows of height below)
// Rows in between live in small rings of row buffers.
#include "verdigris/material/tile.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/aligned_allocator.h"
#include "verdigris/color/convert.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/material/tile.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "verdigris/color/pow-inl.h"
#include "verdigris/forecast/trajectory_row-inl.h"
#include "verdigris/material/change-inl.h"
#include "verdigris/material/row_rings.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {

/// sum_k taps[|k|] rows[k], symmetric, for columns [begin, end) of row buffers (rounded up to
/// whole vectors: the buffers have room).
void blur_columns(const float* const* rows, const std::vector<float>& taps, std::ptrdiff_t begin,
                  std::ptrdiff_t end, float* HWY_RESTRICT out) {
    const hn::ScalableTag<float> d;
    const auto lanes = std::ptrdiff_t(hn::Lanes(d));
    const int radius = int(taps.size()) - 1;
    for (std::ptrdiff_t x = begin; x < end; x += lanes) {
        auto sum = hn::Mul(hn::Set(d, taps[0]), hn::LoadU(d, rows[radius] + x));
        for (int k = 1; k <= radius; ++k) {
            const auto pair =
                hn::Add(hn::LoadU(d, rows[radius - k] + x), hn::LoadU(d, rows[radius + k] + x));
            sum = hn::MulAdd(hn::Set(d, taps[std::size_t(k)]), pair, sum);
        }
        hn::StoreU(sum, d, out + x);
    }
}

template <class D>
HWY_INLINE hn::Vec<D> blur_row_at(D d, const float* at, const std::vector<float>& taps) {
    auto sum = hn::Mul(hn::Set(d, taps[0]), hn::LoadU(d, at));
    for (std::ptrdiff_t k = 1; k < std::ptrdiff_t(taps.size()); ++k) {
        const auto pair = hn::Add(hn::LoadU(d, at - k), hn::LoadU(d, at + k));
        sum = hn::MulAdd(hn::Set(d, taps[std::size_t(k)]), pair, sum);
    }
    return sum;
}

/// Pointers of one image row, at column 0.
struct ColorRow {
    TrajectoryRow source;
    const float *canvas, *dead_zone, *luma_fill;  // luma_fill may be null
    const std::uint8_t* active;                   // may be null: everywhere
    float *albedo, *coverage, *metallic;          // written if `emit`
    float *luma, *p, *rough;                      // row buffers, at column 0 of the image
};

template <bool kEmit, class D>
HWY_INLINE void color_at(D d, const TileJob& job, const ColorRow& row, std::size_t x) {
    const MaterialOptions& o = job.recipe->options;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const RgbOf<D> color = frame_at(d, row.source, job.time, x);
    const auto change = change_of(d, color, load_rgb(d, row.canvas + 3 * x));

    auto e = hn::Mul(hn::Sub(change, hn::LoadU(d, row.dead_zone + x)),
                     hn::Set(d, float(1 / job.recipe->normalizer)));
    e = hn::Min(hn::Max(e, zero), one);
    auto metal_share = one;  // 0 on the backdrop
    if (row.active != nullptr) {
        const hn::Rebind<std::uint8_t, D> d8;
        const hn::RebindToSigned<D> d32;
        const auto active = hn::PromoteTo(d32, hn::LoadU(d8, row.active + x));
        const auto inside = hn::Gt(active, hn::Set(d32, kUnderGlint));
        e = hn::IfThenElseZero(hn::RebindMask(d, inside), e);
        const auto backdrop = hn::Eq(active, hn::Zero(d32));
        metal_share = hn::IfThenZeroElse(hn::RebindMask(d, backdrop), one);
    }

    auto luma = hn::Mul(hn::Set(d, kLumaR), color.r);
    luma = hn::MulAdd(hn::Set(d, kLumaG), color.g, luma);
    luma = hn::MulAdd(hn::Set(d, kLumaB), color.b, luma);
    if (row.luma_fill != nullptr) {
        const auto fill = hn::LoadU(d, row.luma_fill + x);
        luma = hn::IfThenElse(hn::Ge(fill, zero), fill, luma);
    }
    hn::StoreU(luma, d, row.luma + x);

    auto p = zero, p_rough = zero, rest = one;  // p, p^gamma_r, (1 - p)^gamma_m
    const auto covered = hn::Gt(e, zero);
    if (!hn::AllFalse(d, covered)) {
        const auto log_p = hn::Mul(hn::Set(d, float(o.coverage_exponent)), fast_log2(d, e));
        p = hn::IfThenElseZero(covered, hn::Min(fast_exp2(d, log_p), one));
        if (kEmit) {
            p_rough = hn::IfThenElseZero(
                covered, fast_exp2(d, hn::Mul(hn::Set(d, float(o.roughness_gamma)), log_p)));
            const auto left = hn::Sub(one, p);
            rest = hn::IfThenElseZero(
                hn::Gt(left, zero),
                fast_exp2(d, hn::Mul(hn::Set(d, float(o.metallic_gamma)), fast_log2(d, left))));
        }
    }
    hn::StoreU(p, d, row.p + x);
    if (kEmit) {
        rest = hn::Mul(rest, metal_share);
        p_rough = hn::Max(p_rough, hn::Sub(one, metal_share));
        store_rgb(d, color, row.albedo + 3 * x);
        hn::StoreU(p, d, row.coverage + x);
        const auto metal = hn::MulAdd(hn::Set(d, float(o.metallic_clean - o.metallic_patina)), rest,
                                      hn::Set(d, float(o.metallic_patina)));
        hn::StoreU(metal, d, row.metallic + x);
        const auto rough = hn::MulAdd(hn::Set(d, float(o.roughness_patina - o.roughness_clean)),
                                      p_rough, hn::Set(d, float(o.roughness_clean)));
        hn::StoreU(rough, d, row.rough + x);
    }
}

template <bool kEmit>
HWY_INLINE void color_row(const TileJob& job, const ColorRow& row, int begin, int end) {
    const hn::ScalableTag<float> d;
    const hn::CappedTag<float, 1> one;
    const auto lanes = int(hn::Lanes(d));
    int x = begin;
    for (; x + lanes <= end; x += lanes) color_at<kEmit>(d, job, row, std::size_t(x));
    for (; x < end; ++x) color_at<kEmit>(one, job, row, std::size_t(x));
}

/// Blend of smoothed luma and coverage; `smooth` is blurred along the columns already.
void height_row(const float* smooth, const float* p, const TileJob& job, std::ptrdiff_t begin,
                std::ptrdiff_t end, float* HWY_RESTRICT out) {
    const hn::ScalableTag<float> d;
    const float w = float(job.recipe->options.height_patina_weight);
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    for (std::ptrdiff_t x = begin; x < end; x += std::ptrdiff_t(hn::Lanes(d))) {
        const auto luma = blur_row_at(d, smooth + x, job.height_taps);
        const auto h =
            hn::MulAdd(hn::Set(d, 1 - w), luma, hn::Mul(hn::Set(d, w), hn::LoadU(d, p + x)));
        hn::StoreU(hn::Min(hn::Max(h, zero), one), d, out + x);
    }
}

struct SurfaceRow {
    const float *above, *here, *below;  // height
    const float *low, *rough;           // height blurred along columns; roughness without micro
    float *normal, *roughness, *height;
};

template <class D>
HWY_INLINE void surface_at(D d, const TileJob& job, const SurfaceRow& row, std::ptrdiff_t x) {
    const MaterialOptions& o = job.recipe->options;
    const auto one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f);
    const auto load = [d, x](const float* from, std::ptrdiff_t dx)
                          HWY_ATTR { return hn::LoadU(d, from + x + dx); };
    const auto h = load(row.here, 0);
    hn::StoreU(h, d, row.height + x);

    auto micro = hn::Mul(hn::Sub(h, blur_row_at(d, row.low + x, job.micro_taps)),
                         hn::Set(d, float(1 / o.micro_range)));
    micro = hn::Min(hn::Max(micro, hn::Neg(one)), one);
    auto rough = hn::MulAdd(micro, hn::Set(d, float(o.micro_roughness)), load(row.rough, 0));
    rough = hn::Min(hn::Max(rough, hn::Set(d, kMinRoughness)), one);
    hn::StoreU(rough, d, row.roughness + x);

    const auto right =
        hn::Add(hn::Add(load(row.above, 1), load(row.below, 1)), hn::Mul(two, load(row.here, 1)));
    const auto left = hn::Add(hn::Add(load(row.above, -1), load(row.below, -1)),
                              hn::Mul(two, load(row.here, -1)));
    const auto top =
        hn::Add(hn::Add(load(row.above, -1), load(row.above, 1)), hn::Mul(two, load(row.above, 0)));
    const auto bottom =
        hn::Add(hn::Add(load(row.below, -1), load(row.below, 1)), hn::Mul(two, load(row.below, 0)));
    const auto k = hn::Set(d, float(o.normal_scale * o.normal_gain / 8));
    const auto nx = hn::Mul(k, hn::Sub(left, right));  // -k Sobel_x
    const auto ny = hn::Mul(k, hn::Sub(bottom, top));  // +k Sobel_y: y is down, +Y is up
    const auto scale = hn::Div(one, hn::Sqrt(hn::MulAdd(nx, nx, hn::MulAdd(ny, ny, one))));
    const RgbOf<D> n{hn::Mul(nx, scale), hn::Mul(ny, scale), scale};
    store_rgb(d, n, row.normal + 3 * x);
}

void surface_row(const TileJob& job, const SurfaceRow& row, std::ptrdiff_t width) {
    const hn::ScalableTag<float> d;
    const hn::CappedTag<float, 1> one;
    const auto lanes = std::ptrdiff_t(hn::Lanes(d));
    std::ptrdiff_t x = 0;
    for (; x + lanes <= width; x += lanes) surface_at(d, job, row, x);
    for (; x < width; ++x) surface_at(one, job, row, x);
}

/// Colors, coverage and luma of image row y; the maps only where the row belongs to the tile.
void color_stage(const TileJob& job, RowRings& rings, Rect rect, int y) {
    const MaterialRecipe& recipe = *job.recipe;
    const bool inside = y >= rect.y && y < rect.y + rect.height;
    ColorRow row{};
    row.source =
        job.trajectory != nullptr
            ? trajectory_row(*job.trajectory, y)
            : TrajectoryRow{reinterpret_cast<const float*>(job.frame.row(y)), nullptr, nullptr};
    row.canvas = reinterpret_cast<const float*>(recipe.canvas.row(y));
    row.dead_zone = recipe.dead_zone.row(y);
    row.luma_fill = recipe.luma_fill.empty() ? nullptr : recipe.luma_fill.row(y);
    row.active = recipe.active.empty() ? nullptr : recipe.active.row(y);
    row.luma = rings.luma(y) - rect.x;
    row.p = rings.coverage(y) - rect.x;
    row.rough = rings.rough(y) - rect.x;
    row.albedo = reinterpret_cast<float*>(job.out->albedo.row(y));
    row.coverage = job.out->coverage.row(y);
    row.metallic = job.out->metallic.row(y);

    const int begin = std::max(0, rect.x - rings.margin());
    const int end = std::min(job.width, rect.x + rect.width + rings.margin());
    if (inside) {
        color_row<false>(job, row, begin, rect.x);
        color_row<true>(job, row, rect.x, rect.x + rect.width);
        color_row<false>(job, row, rect.x + rect.width, end);
    } else {
        color_row<false>(job, row, begin, end);
    }
    rings.replicate(rings.luma(y), rect, job.width);
    rings.replicate(rings.coverage(y), rect, job.width);
}

void height_stage(const TileJob& job, RowRings& rings, Rect rect, int y) {
    const int radius = int(job.height_taps.size()) - 1, reach = rings.reach();
    const float* rows[2 * kMaxRadius + 1];
    for (int k = -radius; k <= radius; ++k) {
        rows[k + radius] = rings.luma(std::clamp(y + k, 0, job.height - 1));
    }
    blur_columns(rows, job.height_taps, -reach - radius, rect.width + reach + radius,
                 rings.blurred());
    height_row(rings.blurred(), rings.coverage(y), job, -reach, rect.width + reach,
               rings.height(y));
    rings.replicate(rings.height(y), rect, job.width);
}

void surface_stage(const TileJob& job, RowRings& rings, Rect rect, int y) {
    const int radius = int(job.micro_taps.size()) - 1;
    const float* rows[2 * kMaxRadius + 1];
    for (int k = -radius; k <= radius; ++k) {
        rows[k + radius] = rings.height(std::clamp(y + k, 0, job.height - 1));
    }
    blur_columns(rows, job.micro_taps, -radius, rect.width + radius, rings.blurred());
    SurfaceRow row{};
    row.above = rings.height(std::max(y - 1, 0));
    row.here = rings.height(y);
    row.below = rings.height(std::min(y + 1, job.height - 1));
    row.low = rings.blurred();
    row.rough = rings.rough(y);
    row.normal = reinterpret_cast<float*>(job.out->normal.row(y) + rect.x);
    row.roughness = job.out->roughness.row(y) + rect.x;
    row.height = job.out->height.row(y) + rect.x;
    surface_row(job, row, rect.width);
}

void tile(const TileJob& job, RowRings& rings, Rect rect) {
    const int radius = int(job.height_taps.size()) - 1, reach = rings.reach();
    const int last = job.height - 1;
    int next_height = std::max(0, rect.y - reach);
    int next_color = std::max(0, next_height - radius);
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
        for (; next_height <= std::min(last, y + reach); ++next_height) {
            for (; next_color <= std::min(last, next_height + radius); ++next_color) {
                color_stage(job, rings, rect, next_color);
            }
            height_stage(job, rings, rect, next_height);
        }
        surface_stage(job, rings, rect, y);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
namespace {
HWY_EXPORT(tile);
}  // namespace

void materialize_tile(const TileJob& job, Rect rect) {
    // One set per thread, kept between calls: scrubbing allocates nothing.
    static thread_local RowRings rings;
    rings.prepare(int(job.height_taps.size()) - 1, int(job.micro_taps.size()) - 1, rect.width);
    HWY_DYNAMIC_DISPATCH(tile)(job, rings, rect);
}

}  // namespace verdigris
#endif  // HWY_ONCE
