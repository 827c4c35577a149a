// SPDX-License-Identifier: MIT
#include "verdigris/report/figure_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace verdigris {
namespace {

constexpr std::size_t kMostMarks = 25;  // beyond that the marks of a line hide the line
constexpr double kMargin = 0.05;        // of the axis, around the data
constexpr double kGroupShare = 0.8;     // of a category's room that its bars take

bool drawable(double value, const FigureAxis& axis) {
    return std::isfinite(value) && (axis.scale == AxisScale::linear || value > 0);
}

class SpanFinder {
  public:
    explicit SpanFinder(const FigureAxis& axis) : axis_(axis) {}
    void take(double value) {
        if (!drawable(value, axis_)) return;
        lo_ = std::min(lo_, value);
        hi_ = std::max(hi_, value);
    }
    // `tight`: an end that the data reach exactly and no mark crosses, as that of a time axis.
    AxisSpan span(bool tight) const {
        const bool log = axis_.scale == AxisScale::log10;
        double lo = lo_, hi = hi_;
        if (lo > hi) lo = log ? 0.1 : 0, hi = 1;  // nothing to draw
        if (log) lo = std::log10(lo), hi = std::log10(hi);
        if (lo == hi) {
            const double room = log ? 0.5 : std::max(std::abs(lo) * 0.1, 1e-12);
            lo -= room, hi += room;
        } else if (!tight) {
            const double room = (hi - lo) * kMargin;
            // An axis that starts at zero or ends there keeps that end: bars stand on it.
            if (log || lo != 0) lo -= room;
            if (log || hi != 0) hi += room;
        }
        AxisSpan out;
        out.lo = axis_.lo.value_or(log ? std::pow(10, lo) : lo);
        out.hi = axis_.hi.value_or(log ? std::pow(10, hi) : hi);
        // One given end can lie beyond all data.
        if (out.lo >= out.hi) {
            (axis_.lo ? out.hi : out.lo) =
                log ? (axis_.lo ? out.lo * 10 : out.hi / 10) : (axis_.lo ? out.lo + 1 : out.hi - 1);
        }
        return out;
    }

  private:
    const FigureAxis& axis_;
    double lo_ = std::numeric_limits<double>::infinity();
    double hi_ = -std::numeric_limits<double>::infinity();
};

// Where a series stands among those of its kind in the room of a category.
struct Place {
    double offset = 0, half_width = 0;
};

Place place_of(const FigurePanel& panel, std::size_t which) {
    const FigureSeries& series = panel.series[which];
    std::size_t count = 0, before = 0;
    double step = 1;
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        if (panel.series[i].kind != series.kind) continue;
        before += i < which;
        ++count;
    }
    if (panel.x.categories.empty()) {
        // Bars over numbers: as wide as the closest two allow.
        std::vector<double> at;
        for (const FigurePoint& point : series.points) at.push_back(point.x);
        std::sort(at.begin(), at.end());
        double closest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i < at.size(); ++i) {
            if (at[i] > at[i - 1]) closest = std::min(closest, at[i] - at[i - 1]);
        }
        step = std::isfinite(closest) ? closest : 1;
    }
    const bool side_by_side = series.kind == SeriesKind::bars ||
                              (series.kind == SeriesKind::points && !panel.x.categories.empty());
    if (!side_by_side) return {};
    step *= kGroupShare / double(count);
    return {(double(before) - double(count - 1) / 2) * step, step / 2};
}

AxisSpan x_span(const FigurePanel& panel) {
    if (!panel.x.categories.empty()) return {-0.5, double(panel.x.categories.size()) - 0.5, 1, {}};
    SpanFinder finder(panel.x);
    bool lines_only = true;
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        const FigureSeries& series = panel.series[i];
        const Place at = place_of(panel, i);
        for (const FigurePoint& point : series.points) {
            finder.take(point.x + at.offset - at.half_width);
            finder.take(point.x + at.offset + at.half_width);
        }
        const bool bare = series.points.size() > kMostMarks;
        lines_only = lines_only &&
                     (series.kind == SeriesKind::band || (series.kind == SeriesKind::line && bare));
    }
    return finder.span(lines_only);
}

AxisSpan y_span(const FigurePanel& panel) {
    SpanFinder finder(panel.y);
    for (const FigureSeries& series : panel.series) {
        if (series.kind == SeriesKind::bars) finder.take(0);
        for (const FigurePoint& point : series.points) {
            if (series.kind != SeriesKind::band) finder.take(point.y);
            if (!point.bounds) continue;
            finder.take(point.bounds->lo);
            finder.take(point.bounds->hi);
        }
    }
    for (const ReferenceLine& line : panel.references) finder.take(line.y);
    return finder.span(false);
}

PlacedPoint place(const FigurePoint& point, const FigurePanel& panel, const AxisSpan& y,
                  double offset) {
    PlacedPoint out{point.x + offset, point.y, point.y, point.y, false, &point};
    if (!point.bounds) return out;
    const Bounds bounds = *point.bounds;
    if (std::isnan(bounds.lo) || std::isnan(bounds.hi)) return out;
    out.has_bounds = true;
    // An interval down to zero or up to infinity runs off the axis; its end is beyond the frame.
    const auto cut = [&](double v) {
        if (panel.y.scale == AxisScale::log10) return std::clamp(v, y.lo, y.hi);
        return std::isfinite(v) ? v : std::clamp(v, y.lo, y.hi);
    };
    out.lo = cut(bounds.lo);
    out.hi = cut(bounds.hi);
    return out;
}

PlacedSeries place_series(const FigurePanel& panel, std::size_t which, const AxisSpan& y,
                          int& left_out) {
    const FigureSeries& series = panel.series[which];
    const Place at = place_of(panel, which);
    PlacedSeries out;
    out.kind = series.kind;
    out.marks = series.kind == SeriesKind::line && series.points.size() <= kMostMarks;
    out.half_width = at.half_width;
    const bool breaks = series.kind == SeriesKind::line || series.kind == SeriesKind::band;
    bool fresh = true;
    for (const FigurePoint& point : series.points) {
        const PlacedPoint placed = place(point, panel, y, at.offset);
        const bool fine =
            drawable(point.x, panel.x) &&
            (series.kind == SeriesKind::band ? placed.has_bounds : drawable(point.y, panel.y));
        if (!fine) {
            ++left_out;
            fresh = breaks;
            continue;
        }
        if (fresh || out.runs.empty()) out.runs.emplace_back();
        fresh = false;
        out.runs.back().push_back(placed);
    }
    return out;
}

void add_ticks(AxisSpan& span, const FigureAxis& axis) {
    constexpr int kMostTicks = 7;
    span.unit = axis.format.style == NumberStyle::percent ? 100 : 1;
    const bool log = axis.scale == AxisScale::log10;
    // In the unit that is read: round percentages, not round fractions.
    const double lo = span.lo * span.unit, hi = span.hi * span.unit;
    for (const double tick : log ? log_ticks(lo, hi) : linear_ticks(lo, hi, kMostTicks)) {
        std::string label = fmt::format("{:g}", tick);
        if (label.starts_with('-')) label.replace(0, 1, "−");
        if (span.unit != 1) label += " %";
        span.ticks.push_back({tick / span.unit, std::move(label)});
    }
}

std::size_t look_index(FigureLayout& layout, const FigureSeries& series) {
    const auto found = std::find_if(layout.looks.begin(), layout.looks.end(),
                                    [&](const NamedLook& l) { return l.name == series.name; });
    if (found != layout.looks.end()) return std::size_t(found - layout.looks.begin());
    layout.looks.push_back({series.name, series_look(layout.looks.size(), series.muted)});
    return layout.looks.size() - 1;
}

PanelLayout layout_panel(const FigurePanel& panel, FigureLayout& layout) {
    PanelLayout out{panel.title, x_span(panel), y_span(panel), {}};
    if (panel.x.categories.empty()) add_ticks(out.x, panel.x);
    add_ticks(out.y, panel.y);
    bool anything = false;
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        PlacedSeries placed = place_series(panel, i, out.y, layout.left_out);
        placed.look = look_index(layout, panel.series[i]);
        NamedLook& look = layout.looks[placed.look];
        look.line = look.line || placed.kind == SeriesKind::line;
        look.marks = look.marks || placed.marks || placed.kind == SeriesKind::points;
        look.bars = look.bars || placed.kind == SeriesKind::bars;
        look.band = look.band || placed.kind == SeriesKind::band;
        anything = anything || !placed.runs.empty();
        out.series.push_back(std::move(placed));
    }
    for (const ReferenceLine& line : panel.references) {
        auto& names = layout.references;
        if (std::find(names.begin(), names.end(), line.name) == names.end()) {
            names.push_back(line.name);
        }
    }
    if (!anything) out.title += out.title.empty() ? "nothing to draw" : " (nothing to draw)";
    return out;
}

}  // namespace

std::vector<double> linear_ticks(double lo, double hi, int most) {
    std::vector<double> ticks;
    if (!(lo < hi) || !std::isfinite(hi - lo)) return ticks;
    for (int decade = int(std::floor(std::log10((hi - lo) / most)));; ++decade) {
        for (const int mantissa : {1, 2, 5}) {
            // The n-th tick as n * mantissa, scaled once: 0.3 and not 0.30000000000000004.
            const double scale = std::pow(10, std::abs(decade));
            const double step = decade < 0 ? mantissa / scale : mantissa * scale;
            const double slack = 1e-9, first = std::ceil(lo / step - slack);
            const double last = std::floor(hi / step + slack);
            if (last - first + 1 > most) continue;
            for (double n = first; n <= last; ++n) {
                const double at = decade < 0 ? n * mantissa / scale : n * mantissa * scale;
                ticks.push_back(at == 0 ? 0 : at);  // never a negative zero
            }
            return ticks;
        }
    }
}

std::vector<double> log_ticks(double lo, double hi) {
    const int first = int(std::floor(std::log10(lo))), last = int(std::ceil(std::log10(hi)));
    const std::vector<std::vector<int>> choices{
        {1}, {1, 3}, {1, 2, 5}, {1, 2, 3, 4, 5, 6, 7, 8, 9}};
    std::vector<double> ticks;
    for (const std::vector<int>& mantissas : choices) {
        ticks.clear();
        for (int decade = first; decade <= last; ++decade) {
            for (const int m : mantissas) {
                // Division is exact to the last digit where multiplication by 10^-n is not.
                const double tick =
                    decade < 0 ? m / std::pow(10, -decade) : m * std::pow(10, decade);
                if (tick >= lo && tick <= hi) ticks.push_back(tick);
            }
        }
        if (ticks.size() >= 3) break;
    }
    constexpr std::size_t kMost = 8;
    const std::size_t every = ticks.size() > kMost ? (ticks.size() + kMost - 1) / kMost : 1;
    std::vector<double> kept;
    for (std::size_t i = 0; i < ticks.size(); i += every) kept.push_back(ticks[i]);
    return kept;
}

FigureLayout layout_figure(const Figure& figure) {
    check_figure(figure);
    FigureLayout out;
    out.columns = figure.columns > 0 ? figure.columns : figure.panels.size() > 1 ? 2 : 1;
    for (const FigurePanel& panel : figure.panels) out.panels.push_back(layout_panel(panel, out));
    return out;
}

}  // namespace verdigris
