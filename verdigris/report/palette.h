// SPDX-License-Identifier: MIT
// The looks of series: colors that stay apart for color-blind readers, and a dash and a mark each,
// so that no reader and no printer depends on color alone.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace verdigris {

/// A color on white paper and its lighter twin on a dark page; "#rrggbb".
struct InkPair {
    std::string_view light, dark;
};

/// [OkabeIto2008], without their yellow, which is lost on white paper; black is last. The twins are
/// the same hues, chosen for a contrast of at least 4.5 on the page's dark ground.
inline constexpr std::array<InkPair, 7> kSeriesInks{{{"#0072b2", "#56a8dc"},
                                                     {"#d55e00", "#f0843c"},
                                                     {"#009e73", "#35c79b"},
                                                     {"#cc79a7", "#e09cc3"},
                                                     {"#e69f00", "#edb136"},
                                                     {"#56b4e9", "#8fcdf2"},
                                                     {"#000000", "#f0f0f0"}}};
inline constexpr InkPair kMutedInk{"#767676", "#9a9a9a"};
/// Of reference lines, axes and words.
inline constexpr InkPair kTextInk{"#303030", "#d6d6d6"};
inline constexpr InkPair kGridInk{"#dddddd", "#3a3a3a"};

/// Lengths of strokes and gaps, in widths of a line; empty is solid.
inline constexpr std::array<double, 2> kDashed{6, 3}, kDotted{2, 2};
inline constexpr std::array<double, 4> kDashDotted{8, 3, 2, 3};

/// A mark under the names of its two libraries.
struct MarkShape {
    int gnuplot;            ///< `pointtype` of the terminals svg and pngcairo
    std::string_view vega;  ///< `shape` of Vega-Lite
};
inline constexpr std::array<MarkShape, 5> kShapes{
    {{7, "circle"}, {5, "square"}, {9, "triangle-up"}, {13, "diamond"}, {11, "triangle-down"}}};

struct SeriesLook {
    InkPair ink;
    std::span<const double> dash;
    MarkShape shape;
};

/// The look of the i-th series of a figure. The cycles are of different lengths, so that 140 series
/// differ in something.
constexpr SeriesLook series_look(std::size_t i, bool muted) {
    constexpr std::array<std::span<const double>, 4> kDashes{std::span<const double>{}, kDashed,
                                                             kDotted, kDashDotted};
    return {muted ? kMutedInk : kSeriesInks[i % kSeriesInks.size()], kDashes[i % kDashes.size()],
            kShapes[i % kShapes.size()]};
}

}  // namespace verdigris
