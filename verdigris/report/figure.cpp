// SPDX-License-Identifier: MIT
#include "verdigris/report/figure.h"

#include <cmath>

#include "verdigris/error.h"
#include "verdigris/report/escape.h"

namespace verdigris {
namespace {

[[noreturn]] void refuse(const Figure& figure, const std::string& what) {
    throw Error(ErrorCode::failed, "is not drawn: " + what, "figure '" + figure.id + "'");
}

void check_axis(const Figure& figure, const FigureAxis& axis) {
    for (const auto& end : {axis.lo, axis.hi}) {
        if (!end) continue;
        if (!std::isfinite(*end))
            refuse(figure, "an end of axis '" + axis.label + "' is not finite");
        if (axis.scale == AxisScale::log10 && *end <= 0) {
            refuse(figure, "the logarithmic axis '" + axis.label + "' would reach zero");
        }
    }
    if (axis.lo && axis.hi && *axis.lo >= *axis.hi) {
        refuse(figure, "the ends of axis '" + axis.label + "' are not in order");
    }
}

void check_series(const Figure& figure, const FigurePanel& panel, const FigureSeries& series) {
    if (series.name.empty()) refuse(figure, "a series has no name");
    if (series.kind == SeriesKind::bars && panel.y.scale == AxisScale::log10) {
        refuse(figure, "the bars of '" + series.name +
                           "' start at zero, which a logarithmic axis does not have");
    }
    for (const FigurePoint& point : series.points) {
        if (series.kind == SeriesKind::band && !point.bounds) {
            refuse(figure, "the band '" + series.name + "' has a point without bounds");
        }
        const std::size_t count = panel.x.categories.size();
        if (count > 0 &&
            !(point.x >= 0 && point.x < double(count) && point.x == std::floor(point.x))) {
            refuse(figure, "'" + series.name + "' has a point in a category that is not there");
        }
    }
}

}  // namespace

void check_figure(const Figure& figure) {
    if (!is_plain_id(figure.id)) refuse(figure, "its id must be letters, digits, '-' and '_' only");
    if (figure.panels.empty()) refuse(figure, "it has no panel");
    if (figure.columns < 0 || figure.columns > 2) refuse(figure, "a page has one or two columns");
    for (const FigurePanel& panel : figure.panels) {
        check_axis(figure, panel.x);
        check_axis(figure, panel.y);
        if (!panel.y.categories.empty()) refuse(figure, "only an x axis can have categories");
        if (!panel.x.categories.empty() && panel.x.scale == AxisScale::log10) {
            refuse(figure, "categories have no logarithm");
        }
        for (const FigureSeries& series : panel.series) check_series(figure, panel, series);
        for (const ReferenceLine& line : panel.references) {
            if (line.name.empty()) refuse(figure, "a reference line has no name");
        }
    }
}

}  // namespace verdigris
