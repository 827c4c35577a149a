// SPDX-License-Identifier: MIT
#include "verdigris/report/figure_layout.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "verdigris/report/testing.h"

namespace verdigris {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
using Numbers = std::vector<double>;

TEST(FigureLayout, TicksAreRoundNumbers) {
    EXPECT_EQ(linear_ticks(0, 1, 7), (Numbers{0, 0.2, 0.4, 0.6, 0.8, 1}));
    EXPECT_EQ(linear_ticks(-0.15, 0.25, 7), (Numbers{-0.1, 0, 0.1, 0.2}));
    EXPECT_EQ(linear_ticks(0, 980, 7), (Numbers{0, 200, 400, 600, 800}));
    EXPECT_EQ(linear_ticks(0.1, 0.3, 3), (Numbers{0.1, 0.2, 0.3}));
    EXPECT_EQ(linear_ticks(1e9, 1e9 + 6, 7).size(), 7u);
    EXPECT_TRUE(linear_ticks(1, 1, 7).empty());
    EXPECT_EQ(log_ticks(0.001, 100), (Numbers{0.001, 0.01, 0.1, 1, 10, 100}));
    EXPECT_EQ(log_ticks(0.9, 11), (Numbers{1, 3, 10}));
    EXPECT_EQ(log_ticks(2, 4.5), (Numbers{2, 3, 4}));
    EXPECT_LE(log_ticks(1e-200, 1e200).size(), 8u);
}

TEST(FigureLayout, AxesSpanDataIntervalsAndReferences) {
    Figure figure = simple_figure();
    FigurePanel& panel = figure.panels[0];
    panel.references = {{"persistence", -60}};
    panel.series[0].points[2].bounds = Bounds{90, 140};
    const AxisSpan y = layout_figure(figure).panels[0].y;
    EXPECT_DOUBLE_EQ(y.lo, -60 - 200 * 0.05);
    EXPECT_DOUBLE_EQ(y.hi, 140 + 200 * 0.05);
    panel.y.lo = 0, panel.y.hi = 50;
    EXPECT_EQ(layout_figure(figure).panels[0].y.lo, 0);
    EXPECT_EQ(layout_figure(figure).panels[0].y.hi, 50);
}

TEST(FigureLayout, PercentagesAreReadInPercent) {
    Figure figure = simple_figure();
    figure.panels[0].y.format.style = NumberStyle::percent;
    figure.panels[0].series[0].points = {{0, -0.1}, {1, 0.1}};
    const AxisSpan y = layout_figure(figure).panels[0].y;
    EXPECT_EQ(y.unit, 100);
    ASSERT_EQ(y.ticks.size(), 5u);
    EXPECT_EQ(y.ticks[0].label, "−10 %");
    EXPECT_DOUBLE_EQ(y.ticks[0].at, -0.1);
    EXPECT_EQ(y.ticks[2].label, "0 %");
}

TEST(FigureLayout, WhatCannotBeDrawnBreaksTheLineAndIsCounted) {
    Figure figure = simple_figure();
    figure.panels[0].series[0].points = {{0, 1}, {1, kNan}, {2, 3}, {3, 4}, {4, kInf}, {5, -1}};
    FigureLayout layout = layout_figure(figure);
    EXPECT_EQ(layout.left_out, 2);
    ASSERT_EQ(layout.panels[0].series[0].runs.size(), 3u);
    EXPECT_EQ(layout.panels[0].series[0].runs[1].size(), 2u);
    figure.panels[0].y.scale = AxisScale::log10;
    layout = layout_figure(figure);
    EXPECT_EQ(layout.left_out, 3);
    EXPECT_GT(layout.panels[0].y.lo, 0);
    figure.panels[0].series[0].points = {{0, kNan}};
    EXPECT_EQ(layout_figure(figure).panels[0].title, "nothing to draw");
}

TEST(FigureLayout, IntervalsAreCutAtTheEndsOfALogarithmicAxis) {
    Figure figure = simple_figure();
    figure.panels[0].y.scale = AxisScale::log10;
    figure.panels[0].series[0].points[0].bounds = Bounds{-1, 5};
    const PanelLayout panel = layout_figure(figure).panels[0];
    const PlacedPoint& point = panel.series[0].runs[0][0];
    EXPECT_EQ(point.lo, panel.y.lo);
    EXPECT_EQ(point.hi, 5);
    EXPECT_EQ(point.source->bounds->lo, -1);  // for the tooltip
}

TEST(FigureLayout, SeriesStandSideBySideInACategory) {
    Figure figure = simple_figure();
    FigurePanel& panel = figure.panels[0];
    panel.x.categories = {"a", "b", "c"};
    const std::vector<FigurePoint> points{{0, 1}, {1, 2}, {2, 3}};
    panel.series = {{"one", SeriesKind::bars, points}, {"two", SeriesKind::bars, points}};
    const PanelLayout layout = layout_figure(figure).panels[0];
    const PlacedPoint &left = layout.series[0].runs[0][1], &right = layout.series[1].runs[0][1];
    EXPECT_DOUBLE_EQ(left.x, 0.8);
    EXPECT_DOUBLE_EQ(right.x, 1.2);
    EXPECT_DOUBLE_EQ(layout.series[0].half_width, 0.2);
    EXPECT_EQ(layout.x.lo, -0.5);
    EXPECT_EQ(layout.x.hi, 2.5);
    EXPECT_EQ(layout.y.lo, 0);
}

TEST(FigureLayout, ANameHasOneLookInAllPanels) {
    Figure figure = simple_figure();
    figure.panels.push_back(figure.panels[0]);
    figure.panels[1].series.insert(figure.panels[1].series.begin(),
                                   {"other", SeriesKind::points, {{0, 1}}});
    figure.panels[1].references = {{"zero", 0}, {"zero", 1}};
    const FigureLayout layout = layout_figure(figure);
    ASSERT_EQ(layout.looks.size(), 2u);
    EXPECT_EQ(layout.panels[0].series[0].look, layout.panels[1].series[1].look);
    EXPECT_EQ(layout.references, std::vector<std::string>{"zero"});
    EXPECT_TRUE(layout.has_legend());
    EXPECT_FALSE(layout_figure(simple_figure()).has_legend());
    EXPECT_EQ(layout.columns, 2);
}

TEST(FigureLayout, ManySeriesDifferInSomething) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < 140; ++i) {
        const SeriesLook look = series_look(i, false);
        seen.insert(std::string(look.ink.light) + "/" + std::to_string(look.dash.size()) +
                    (look.dash.empty() ? "" : std::to_string(look.dash[0])) + "/" +
                    std::string(look.shape.vega));
    }
    EXPECT_EQ(seen.size(), 140u);
}

}  // namespace
}  // namespace verdigris
