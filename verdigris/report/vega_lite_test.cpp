// SPDX-License-Identifier: MIT
#include "verdigris/report/vega_lite.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "verdigris/report/testing.h"

namespace verdigris {
namespace {

using nlohmann::json;

TEST(VegaLite, TheDataAreTheFiguresAndTheWordsThoseOfATable) {
    Figure figure = simple_figure();
    FigurePanel& panel = figure.panels[0];
    panel.y.format = {NumberStyle::percent, 1, true};
    panel.series[0].points = {{0, 0.064, Bounds{-0.01, 0.1}}, {1, 1.0 / 3}};
    panel.references = {{"persistence", 0}};
    const json spec = json::parse(vega_lite_spec(figure));
    const json& layers = spec["concat"][0]["layer"];
    ASSERT_EQ(layers.size(), 4u);  // reference, line, strokes of the intervals, marks
    EXPECT_EQ(layers[0]["data"]["values"][0]["y_says"], "0.0 %");
    const json& rows = layers[3]["data"]["values"];
    EXPECT_EQ(rows[0]["series"], "affinergb");
    EXPECT_EQ(rows[0]["y_says"], "+6.4 % [−1.0 %, +10.0 %]");
    EXPECT_EQ(rows[0]["lo"], -0.01);
    EXPECT_EQ(rows[1]["y"], 1.0 / 3);
    EXPECT_FALSE(rows[1].contains("lo"));
    EXPECT_EQ(layers[3]["encoding"]["tooltip"][2]["field"], "y_says");
    const json& scale = layers[3]["encoding"]["color"]["scale"];
    EXPECT_EQ(scale["domain"], (json{"affinergb", "persistence"}));
    EXPECT_EQ(scale["range"][0], "#0072b2");
    EXPECT_EQ(spec["usermeta"]["inks"]["#0072b2"], "#56a8dc");
}

TEST(VegaLite, LoadsNothing) {
    const std::string spec = vega_lite_spec(simple_figure());
    EXPECT_EQ(spec.find("\"url\""), std::string::npos);
}

TEST(VegaLite, CategoriesAndNamesAreStringsInAnyLanguage) {
    Figure figure = simple_figure();
    figure.panels[0].x.categories = {"a\"b\\", "</script>", "\xff"};
    figure.panels[0].series[0].kind = SeriesKind::bars;
    const json spec = json::parse(vega_lite_spec(figure));
    const json& layer = spec["concat"][0]["layer"][0];
    EXPECT_EQ(layer["encoding"]["x"]["axis"]["labelExpr"],
              "[\"a\\\"b\\\\\",\"</script>\",\"\xef\xbf\xbd\"][datum.value]");
    EXPECT_EQ(layer["data"]["values"][1]["x_says"], "</script>");
    EXPECT_EQ(layer["encoding"]["y2"]["datum"], 0);
}

TEST(VegaLite, NothingThatIsNotFiniteGetsIn) {
    Figure figure = simple_figure();
    const double inf = std::numeric_limits<double>::infinity();
    figure.panels[0].series[0].points = {{0, 1, Bounds{-inf, inf}}, {1, inf}, {2, 2}};
    figure.panels[0].references = {{"nowhere", inf}};
    const std::string spec = vega_lite_spec(figure);
    const json rows = json::parse(spec)["concat"][0]["layer"][0]["data"]["values"];
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0]["y_says"], "1.000 [−∞, ∞]");
    EXPECT_TRUE(rows[0]["lo"].is_number());
    EXPECT_EQ(rows[1]["run"], 1);
}

}  // namespace
}  // namespace verdigris
