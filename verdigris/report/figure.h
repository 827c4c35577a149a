// SPDX-License-Identifier: MIT
// A figure as plain data: draw_figure.h makes SVG and PNG of it, vega_lite.h an interactive chart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verdigris/report/number_text.h"
#include "verdigris/report/table.h"

namespace verdigris {

enum class AxisScale { linear, log10 };

struct FigureAxis {
    std::string label;  ///< with the unit
    AxisScale scale = AxisScale::linear;
    /// Ends of the axis; without them it spans the data, the intervals and the reference lines with
    /// a margin. What lies beyond a given end is clipped.
    std::optional<double> lo = {}, hi = {};
    /// Of an x axis only: the points' x are then indices into this list, and several series of bars
    /// or points stand side by side.
    std::vector<std::string> categories = {};
    /// Of the values in tooltips. With NumberStyle::percent the data are fractions, and the ticks
    /// read in percent.
    NumberFormat format = {};
};

enum class SeriesKind {
    line,    ///< joined in the order given; marked too where there are few points; bounds: bars
    points,  ///< one mark per point; bounds: error bars
    bars,    ///< from zero; bounds: error bars; only on a linear y axis
    band,    ///< the area between the bounds; y is not drawn
};

struct FigurePoint {
    double x = 0, y = 0;
    std::optional<Bounds> bounds = {};
};

struct FigureSeries {
    /// Series of one name share color, dash and mark in all panels, and one entry of the legend: a
    /// line and its band carry the same name.
    std::string name;
    SeriesKind kind = SeriesKind::line;
    std::vector<FigurePoint> points;
    bool muted = false;  ///< gray: for what is only context
};

/// A horizontal line across the panel, in the legend by its name: persistence at its error, or 0 %.
struct ReferenceLine {
    std::string name;
    double y = 0;
};

struct FigurePanel {
    std::string title;  ///< may be empty
    FigureAxis x, y;
    std::vector<FigureSeries> series;
    std::vector<ReferenceLine> references = {};
};

struct Figure {
    std::string id;       ///< file name: letters, digits, "-", "_"
    std::string title;    ///< a few words: the table of contents, the heading
    std::string caption;  ///< what is shown; what bars and bands are
    std::vector<FigurePanel> panels;
    /// Panels side by side: 1 is a column of a paper wide (3.5 in), 2 a page (7 in). 0: one for one
    /// panel, two for more.
    int columns = 0;
};

/// Throws Error{failed} naming the figure: an id that is no plain id, no panel, a series without a
/// name, bars on a logarithmic axis, a band without bounds, ends of an axis that are not a range, a
/// category that is not there. Every writer calls it. What is merely not finite is left out of the
/// drawing instead (figure_layout.h counts it).
void check_figure(const Figure& figure);

}  // namespace verdigris
