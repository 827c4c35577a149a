// SPDX-License-Identifier: MIT
#include "verdigris/report/figure.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "verdigris/files/testing.h"
#include "verdigris/report/testing.h"

namespace verdigris {
namespace {

std::string complaint(const std::function<void(Figure&)>& change) {
    Figure figure = simple_figure();
    change(figure);
    const Error error = error_of([&] { check_figure(figure); });
    EXPECT_EQ(error.code(), ErrorCode::failed);
    return error.what();
}

TEST(Figure, WhatCannotBeDrawnIsRefusedByName) {
    EXPECT_NO_THROW(check_figure(simple_figure()));
    const auto holds = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    EXPECT_EQ(complaint([](Figure& f) { f.panels.clear(); }),
              "figure 'simple': is not drawn: it has no panel");
    EXPECT_TRUE(holds(complaint([](Figure& f) { f.id = "a b"; }), "its id"));
    EXPECT_TRUE(holds(complaint([](Figure& f) { f.panels[0].series[0].name = ""; }), "no name"));
    EXPECT_TRUE(holds(complaint([](Figure& f) {
                          f.panels[0].series[0].kind = SeriesKind::bars;
                          f.panels[0].y.scale = AxisScale::log10;
                      }),
                      "start at zero"));
    EXPECT_TRUE(holds(complaint([](Figure& f) { f.panels[0].series[0].kind = SeriesKind::band; }),
                      "without bounds"));
    EXPECT_TRUE(holds(complaint([](Figure& f) { f.panels[0].y.lo = 3, f.panels[0].y.hi = 3; }),
                      "not in order"));
    EXPECT_TRUE(holds(complaint([](Figure& f) {
                          f.panels[0].y.scale = AxisScale::log10;
                          f.panels[0].y.lo = 0;
                      }),
                      "reach zero"));
    EXPECT_TRUE(holds(complaint([](Figure& f) { f.panels[0].x.categories = {"a"}; }),
                      "a category that is not there"));
    EXPECT_TRUE(holds(complaint([](Figure& f) { f.columns = 3; }), "columns"));
}

}  // namespace
}  // namespace verdigris
