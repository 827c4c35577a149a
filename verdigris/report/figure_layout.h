// SPDX-License-Identifier: MIT
// What both drawings of a figure must agree on: ends of axes, places side by side, looks by name.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "verdigris/report/figure.h"
#include "verdigris/report/palette.h"

namespace verdigris {

/// A point that can be drawn, in the axes' values.
struct PlacedPoint {
    double x = 0, y = 0;    ///< x moved beside its neighbors where there are categories
    double lo = 0, hi = 0;  ///< cut at the ends of a logarithmic axis; y without bounds
    bool has_bounds = false;
    const FigurePoint* source = nullptr;  ///< as the caller gave it; lives as long as the figure
};

struct PlacedSeries {
    std::size_t look = 0;  ///< index into FigureLayout::looks
    SeriesKind kind = SeriesKind::line;
    bool marks = false;     ///< of a line: also a mark at each point
    double half_width = 0;  ///< of bars
    /// A line and a band break where a point cannot be drawn; points and bars are one run.
    std::vector<std::vector<PlacedPoint>> runs;
};

struct AxisTick {
    double at = 0;
    std::string label;  ///< typeset; with " %" where the axis reads in percent
};

struct AxisSpan {
    double lo = 0, hi = 1;        ///< in the axes' values
    double unit = 1;              ///< 100 where fractions are read in percent
    std::vector<AxisTick> ticks;  ///< none where there are categories
};

struct PanelLayout {
    std::string title;  ///< says so where there is nothing to draw
    AxisSpan x, y;
    std::vector<PlacedSeries> series;
};

/// One entry of the legend: a name and all that is drawn under it.
struct NamedLook {
    std::string name;
    SeriesLook look;
    bool line = false, marks = false, bars = false, band = false;
};

struct FigureLayout {
    std::vector<NamedLook> looks;         ///< in the order in which the names appear
    std::vector<std::string> references;  ///< names of reference lines, each once
    std::vector<PanelLayout> panels;
    int columns = 1;
    /// Points that are not finite, or not above zero on a logarithmic axis.
    int left_out = 0;

    /// One series and nothing beside it needs no legend.
    bool has_legend() const { return looks.size() + references.size() > 1; }
};

/// Throws as check_figure. Deterministic; linear in the number of points.
FigureLayout layout_figure(const Figure& figure);

/// Round numbers (1, 2, 5 times a power of ten) in [lo, hi]; at most `most` of them.
std::vector<double> linear_ticks(double lo, double hi, int most);
/// Powers of ten, with 2 and 5 or more between where there are few; at most eight.
std::vector<double> log_ticks(double lo, double hi);

}  // namespace verdigris
