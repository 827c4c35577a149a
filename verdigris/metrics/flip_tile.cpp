// SPDX-License-Identifier: MIT
// Columns are filtered first: a ring holds three channels of the rows around, and what is made of
// them, seven rows, stays in the first cache until the rows are filtered.
//
// A symmetric filter of sum 1 is computed as c + sum_i w_i (v[i] + v[-i] - 2 c): a surface of one
// color stays that color to the last digit, and the feature detectors give 0 on it, not a rounding
// error that a square root would lift to 1e-4.
#include "verdigris/metrics/flip_tile.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "verdigris/metrics/flip_color.h"
#include "verdigris/metrics/flip_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/metrics/flip_tile.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "verdigris/metrics/flip_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {

/// `count` pixels of encoded sRGB as opponent colors. Writes whole vectors, reads no pixel more.
void convert_row(const float* rgb, int count, FlipRows& rows, int y, int first) {
    const hn::ScalableTag<float> d;
    const FlipColor& color = flip_color();
    const int lanes = int(hn::Lanes(d));
    float *luma = rows.converted(FlipRows::luma, y) + first,
          *red_green = rows.converted(FlipRows::red_green, y) + first,
          *blue_yellow = rows.converted(FlipRows::blue_yellow, y) + first;
    HWY_ALIGN float padded[3 * FlipRows::kVector] = {};
    if (count < lanes) {
        std::memcpy(padded, rgb, std::size_t(3 * count) * sizeof(float));
        rgb = padded;
        count = lanes;
    }
    for (int x = 0; x < count; x += lanes) {
        const int at = std::min(x, count - lanes);  // the last one again over the one before
        Three<hn::ScalableTag<float>> c;
        load_rgb(d, rgb + 3 * at, c);
        c = {linear_of(d, c.x), linear_of(d, c.y), linear_of(d, c.z)};
        c = product(d, color.opponent_from_linear, c);
        hn::StoreU(c.x, d, luma + at);
        hn::StoreU(c.y, d, red_green + at);
        hn::StoreU(c.z, d, blue_yellow + at);
    }
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V pair_sum(D d, const RowsAround& column, std::size_t i, int x) {
    return hn::Add(hn::LoadU(d, column.above[i] + x), hn::LoadU(d, column.below[i] + x));
}

/// Columns [begin, end) of a row from the rows around it, one RowsAround a channel.
void filter_columns(const FlipFilters& f, const RowsAround* columns, int begin, int end,
                    FlipRows& rows) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const int lanes = int(hn::Lanes(d));
    const auto store = [&](V v, FlipRows::Filtered which, int x)
                           HWY_ATTR { hn::StoreU(v, d, rows.filtered(which) + x); };
    for (int x = begin; x < end; x += lanes) {
        const RowsAround& luma = columns[FlipRows::luma];
        const V center = hn::LoadU(d, luma.above[0] + x), twice = hn::Add(center, center);
        V blurred = center, smooth = center, edge = hn::Zero(d), point = hn::Zero(d);
        std::size_t i = 1;
        const auto features = [&](V bend, V slope) HWY_ATTR {
            smooth = hn::MulAdd(hn::Set(d, f.smooth[i]), bend, smooth);
            edge = hn::MulAdd(hn::Set(d, f.edge[i]), slope, edge);
            point = hn::MulAdd(hn::Set(d, f.point[i]), bend, point);
        };
        for (; i < f.smooth.size(); ++i) {
            const V up = hn::LoadU(d, luma.above[i] + x), down = hn::LoadU(d, luma.below[i] + x);
            const V bend = hn::Sub(hn::Add(up, down), twice);
            if (i < f.luma.size()) blurred = hn::MulAdd(hn::Set(d, f.luma[i]), bend, blurred);
            features(bend, hn::Sub(down, up));
        }
        store(blurred, FlipRows::blurred_luma, x);
        store(smooth, FlipRows::smooth, x);
        store(edge, FlipRows::edge, x);
        store(point, FlipRows::point, x);

        const RowsAround& red_green = columns[FlipRows::red_green];
        const V red = hn::LoadU(d, red_green.above[0] + x), two_red = hn::Add(red, red);
        V sum = red;
        for (i = 1; i < f.red_green.size(); ++i) {
            sum = hn::MulAdd(hn::Set(d, f.red_green[i]),
                             hn::Sub(pair_sum(d, red_green, i, x), two_red), sum);
        }
        store(sum, FlipRows::blurred_red_green, x);

        const RowsAround& blue = columns[FlipRows::blue_yellow];
        const V middle = hn::LoadU(d, blue.above[0] + x);
        V wide = hn::Mul(middle, hn::Set(d, f.blue_wide[0])),
          narrow = hn::Mul(middle, hn::Set(d, f.blue_narrow[0]));
        for (i = 1; i < f.blue_wide.size(); ++i) {
            const V pair = pair_sum(d, blue, i, x);
            wide = hn::MulAdd(hn::Set(d, f.blue_wide[i]), pair, wide);
            narrow = hn::MulAdd(hn::Set(d, f.blue_narrow[i]), pair, narrow);
        }
        store(wide, FlipRows::wide, x);
        store(narrow, FlipRows::narrow, x);
    }
}

/// What is seen at one place of a picture.
template <class D>
struct Seen {
    Three<D> lab;
    hn::Vec<D> edge, point;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Seen<D> filter_rows(D d, const FlipFilters& f, const FlipColor& color, FlipRows& rows,
                               int x) {
    const auto at = [&](FlipRows::Filtered which) { return rows.filtered(which) + x; };
    const auto pair = [&](const float* row, std::size_t i) HWY_ATTR {
        return hn::Add(hn::LoadU(d, row - i), hn::LoadU(d, row + i));
    };
    const auto blurred = [&](const float* row, const std::vector<float>& taps) HWY_ATTR {
        const V center = hn::LoadU(d, row), twice = hn::Add(center, center);
        V sum = center;
        for (std::size_t i = 1; i < taps.size(); ++i) {
            sum = hn::MulAdd(hn::Set(d, taps[i]), hn::Sub(pair(row, i), twice), sum);
        }
        return sum;
    };
    Three<D> opponent;
    opponent.x = blurred(at(FlipRows::blurred_luma), f.luma);
    opponent.y = blurred(at(FlipRows::blurred_red_green), f.red_green);
    const float *wide = at(FlipRows::wide), *narrow = at(FlipRows::narrow);
    V sum_wide = hn::Mul(hn::LoadU(d, wide), hn::Set(d, f.blue_wide[0])),
      sum_narrow = hn::Mul(hn::LoadU(d, narrow), hn::Set(d, f.blue_narrow[0]));
    for (std::size_t i = 1; i < f.blue_wide.size(); ++i) {
        sum_wide = hn::MulAdd(hn::Set(d, f.blue_wide[i]), pair(wide, i), sum_wide);
        sum_narrow = hn::MulAdd(hn::Set(d, f.blue_narrow[i]), pair(narrow, i), sum_narrow);
    }
    opponent.z = hn::Add(sum_wide, sum_narrow);

    const float *smooth = at(FlipRows::smooth), *edge = at(FlipRows::edge),
                *point = at(FlipRows::point);
    const V smooth_2 = hn::Add(hn::LoadU(d, smooth), hn::LoadU(d, smooth)),
            edge_0 = hn::LoadU(d, edge), edge_2 = hn::Add(edge_0, edge_0),
            point_0 = hn::LoadU(d, point), point_2 = hn::Add(point_0, point_0);
    V edge_x = hn::Zero(d), point_x = hn::Zero(d), edge_y = edge_0, point_y = point_0;
    for (std::size_t i = 1; i < f.smooth.size(); ++i) {
        const V left = hn::LoadU(d, smooth - i), right = hn::LoadU(d, smooth + i);
        edge_x = hn::MulAdd(hn::Set(d, f.edge[i]), hn::Sub(right, left), edge_x);
        point_x =
            hn::MulAdd(hn::Set(d, f.point[i]), hn::Sub(hn::Add(left, right), smooth_2), point_x);
        const V weight = hn::Set(d, f.smooth[i]);
        edge_y = hn::MulAdd(weight, hn::Sub(pair(edge, i), edge_2), edge_y);
        point_y = hn::MulAdd(weight, hn::Sub(pair(point, i), point_2), point_y);
    }
    return {hunt_lab(d, color, opponent),
            hn::Sqrt(hn::MulAdd(edge_x, edge_x, hn::Mul(edge_y, edge_y))),
            hn::Sqrt(hn::MulAdd(point_x, point_x, hn::Mul(point_y, point_y)))};
}

void error_row(const FlipFilters& f, FlipRows& reference, FlipRows& test, int width, float* out) {
    const hn::ScalableTag<float> d;
    const FlipColor& color = flip_color();
    for (int x = 0; x < width; x += int(hn::Lanes(d))) {
        const auto one = filter_rows(d, f, color, reference, x);
        const auto two = filter_rows(d, f, color, test, x);
        const auto feature =
            hn::Max(hn::AbsDiff(one.edge, two.edge), hn::AbsDiff(one.point, two.point));
        hn::StoreU(flip_error(d, color, hyab(d, one.lab, two.lab), feature), d, out + x);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
namespace {

HWY_EXPORT(convert_row);
HWY_EXPORT(filter_columns);
HWY_EXPORT(error_row);

/// Row y of `image` around the tile's columns; beyond its border its outermost pixels go on.
void convert(ImageView<const SrgbF> image, Rect tile, int reach, int y, FlipRows& rows) {
    const int begin = std::max(tile.x - reach, 0),
              end = std::min(tile.x + tile.width + reach, image.width());
    HWY_DYNAMIC_DISPATCH(convert_row)
    (reinterpret_cast<const float*>(image.row(y) + begin), end - begin, rows, y, begin - tile.x);
    for (int c = 0; c < FlipRows::kChannels; ++c) {
        float* row = rows.converted(FlipRows::Channel(c), y);
        std::fill(row - reach, row + begin - tile.x, row[begin - tile.x]);
        std::fill(row + end - tile.x, row + tile.width + reach, row[end - tile.x - 1]);
    }
}

void filter_around(const FlipFilters& filters, int reach, int y, int width, int height,
                   FlipRows& rows) {
    std::vector<const float*> pointers;
    pointers.reserve(std::size_t(FlipRows::kChannels * 2 * (reach + 1)));
    RowsAround columns[FlipRows::kChannels];
    for (int c = 0; c < FlipRows::kChannels; ++c) {
        for (const int direction : {-1, 1}) {
            const auto first = std::ptrdiff_t(pointers.size());
            for (int i = 0; i <= reach; ++i) {
                const int at = std::clamp(y + direction * i, 0, height - 1);
                pointers.push_back(rows.converted(FlipRows::Channel(c), at));
            }
            (direction < 0 ? columns[c].above : columns[c].below) = pointers.data() + first;
        }
    }
    HWY_DYNAMIC_DISPATCH(filter_columns)(filters, columns, -rows.margin(), width + reach, rows);
}

}  // namespace

void flip_tile(ImageView<const SrgbF> reference, ImageView<const SrgbF> test,
               const FlipFilters& filters, Rect tile, Image<float>& map) {
    const int reach = filters.reach(), height = reference.height();
    FlipRows reference_rows(tile.width, reach), test_rows(tile.width, reach);
    std::vector<float> errors(std::size_t(tile.width + FlipRows::kVector));
    int converted = std::max(tile.y - reach, 0);
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (; converted <= std::min(y + reach, height - 1); ++converted) {
            convert(reference, tile, reach, converted, reference_rows);
            convert(test, tile, reach, converted, test_rows);
        }
        filter_around(filters, reach, y, tile.width, height, reference_rows);
        filter_around(filters, reach, y, tile.width, height, test_rows);
        HWY_DYNAMIC_DISPATCH(error_row)
        (filters, reference_rows, test_rows, tile.width, errors.data());
        std::copy_n(errors.data(), tile.width, map.row(y) + tile.x);
    }
}

}  // namespace verdigris
#endif  // HWY_ONCE
