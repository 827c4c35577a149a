// SPDX-License-Identifier: MIT
// The vocabulary is that of [VegaLite]: a panel is a view of layers, the panels are concatenated.
#include "verdigris/report/vega_lite.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "verdigris/report/escape.h"
#include "verdigris/report/figure_layout.h"
#include "verdigris/report/table_formats.h"

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kWideWidth = 640, kNarrowWidth = 300, kHeight = 260;  // px; the page may change them
constexpr const char* kListener = "listener";
constexpr const char* kPick = "picked";  // the selection of the legend

// Each name of the legend with its own value.
template <class OfLook>
Json by_name(const FigureLayout& layout, OfLook of_look, const Json& of_reference) {
    Json values = Json::object();
    for (const NamedLook& look : layout.looks) values[one_line(look.name)] = of_look(look);
    for (const std::string& name : layout.references) values[one_line(name)] = of_reference;
    return values;
}

// How the entries of the legend look, for the page's script: Vega-Lite has no words for entries
// that differ in kind. Marks and bars are filled, without an outline that dashes would notch.
Json legend_looks(const FigureLayout& layout) {
    const auto filled = [](const NamedLook& l) { return l.marks || l.bars || !l.line; };
    const auto shape = [](const NamedLook& l) {
        if (l.marks) return std::string(l.look.shape.vega);
        return std::string(l.line ? "stroke" : "square");
    };
    return {{"shape", by_name(layout, shape, "stroke")},
            {"size", by_name(
                         layout, [&](const auto& l) { return filled(l) ? 90 : 400; }, 400)},
            {"strokeWidth", by_name(
                                layout, [&](const auto& l) { return filled(l) ? 0 : 2; }, 1.5)}};
}

// Field "series" on one channel: looks first, then reference lines, each with its own value.
template <class OfLook>
Json series_channel(const FigureLayout& layout, OfLook of_look, const Json& of_reference) {
    Json domain = Json::array(), range = Json::array();
    for (const NamedLook& look : layout.looks) {
        domain.push_back(one_line(look.name));
        range.push_back(of_look(look));
    }
    for (const std::string& name : layout.references) {
        domain.push_back(one_line(name));
        range.push_back(of_reference);
    }
    Json out = {{"field", "series"},
                {"type", "nominal"},
                {"scale", {{"domain", domain}, {"range", range}}},
                {"legend", nullptr}};
    // The same for all channels: then they are one legend.
    if (layout.has_legend()) {
        out["legend"] = {
            {"title", nullptr}, {"orient", "top"}, {"symbolOpacity", 1}, {"labelLimit", 300}};
    }
    return out;
}

Json color_channel(const FigureLayout& layout) {
    return series_channel(
        layout, [](const NamedLook& l) { return std::string(l.look.ink.light); },
        std::string(kTextInk.light));
}
Json dash_channel(const FigureLayout& layout) {
    const auto pixels = [](std::span<const double> dash) {
        Json out = Json::array();
        for (const double d : dash) out.push_back(d * 1.5);  // px for widths of a line of 2 px
        if (out.empty()) out = {1, 0};
        return out;
    };
    return series_channel(
        layout, [&](const NamedLook& l) { return pixels(l.look.dash); }, Json{6, 3});
}
Json shape_channel(const FigureLayout& layout) {
    return series_channel(
        layout, [](const NamedLook& l) { return std::string(l.look.shape.vega); }, "circle");
}

Json axis_channel(const char* field, const FigureAxis& axis, const AxisSpan& span) {
    Json ticks = Json::array(), names = Json::array();
    std::string label = "format(datum.value * " + exact_number(span.unit) + ", '~g')";
    if (span.unit != 1) label += " + ' %'";
    for (const AxisTick& tick : span.ticks) ticks.push_back(tick.at);
    Json out_axis = {{"title", one_line(axis.label)}, {"grid", *field == 'y'}};
    if (!axis.categories.empty()) {
        int longest = 0;
        for (std::size_t i = 0; i < axis.categories.size(); ++i) {
            ticks.push_back(i);
            names.push_back(one_line(axis.categories[i]));
            longest = std::max(longest, character_count(axis.categories[i]));
        }
        label = names.dump() + "[datum.value]";  // JSON strings are string literals there, too
        // Level only where they fit on a telephone.
        const bool crowded = longest * int(axis.categories.size()) > 34;
        out_axis["labelAngle"] = crowded ? -35 : 0;
        out_axis["labelLimit"] = 160;
        out_axis["labelOverlap"] = false;
        out_axis["ticks"] = false;
    }
    out_axis["values"] = ticks;
    out_axis["labelExpr"] = label;
    Json scale = {{"type", axis.scale == AxisScale::log10 ? "log" : "linear"},
                  {"domain", {span.lo, span.hi}},
                  {"nice", false}};
    if (axis.scale == AxisScale::linear) scale["zero"] = false;
    return {{"field", field}, {"type", "quantitative"}, {"scale", scale}, {"axis", out_axis}};
}

std::string x_words(const FigureAxis& axis, double x) {
    if (!axis.categories.empty()) return one_line(axis.categories[std::size_t(x)]);
    return cell_text(TableCell(x), axis.format, true);
}

// What is finite; a tooltip keeps the words also of what is cut.
Json row(const FigurePanel& panel, const std::string& name, const PlacedSeries& series,
         const PlacedPoint& point, std::size_t run) {
    const FigurePoint& given = *point.source;
    TableCell value = given.bounds ? TableCell(given.y, *given.bounds) : TableCell(given.y);
    std::string words = cell_text(value, panel.y.format, true);
    if (series.kind == SeriesKind::band) {
        words = cell_text(TableCell(given.bounds->lo), panel.y.format, true) + " to " +
                cell_text(TableCell(given.bounds->hi), panel.y.format, true);
    }
    Json out = {{"series", name},
                {"x", point.x},
                {"y", point.y},
                {"x_says", x_words(panel.x, given.x)},
                {"y_says", words}};
    if (point.has_bounds) out["lo"] = point.lo, out["hi"] = point.hi;
    if (series.kind == SeriesKind::bars) {
        out["left"] = point.x - series.half_width * 0.92;
        out["right"] = point.x + series.half_width * 0.92;
    }
    out["run"] = run;
    return out;
}

class PanelSpec {
  public:
    PanelSpec(const FigurePanel& panel, const PanelLayout& placed, const FigureLayout& layout)
        : panel_(panel), placed_(placed), layout_(layout) {}

    Json layers() {
        for (const PlacedSeries& series : placed_.series) {
            if (series.kind == SeriesKind::band) add_series(series);
        }
        for (const PlacedSeries& series : placed_.series) {
            if (series.kind == SeriesKind::bars) add_series(series);
        }
        add_references();
        for (const PlacedSeries& series : placed_.series) {
            if (series.kind == SeriesKind::line || series.kind == SeriesKind::points) {
                add_series(series);
            }
        }
        return std::move(layers_);
    }

  private:
    Json encoding(bool tooltip) const {
        Json out = {{"x", axis_channel("x", panel_.x, placed_.x)},
                    {"y", axis_channel("y", panel_.y, placed_.y)},
                    {"color", color_channel(layout_)}};
        const auto words = [](const char* field, const std::string& title) {
            return Json{{"field", field}, {"type", "nominal"}, {"title", one_line(title)}};
        };
        if (tooltip) {
            out["tooltip"] = {words("series", "series"),
                              words("x_says", panel_.x.label.empty() ? "at" : panel_.x.label),
                              words("y_says", panel_.y.label.empty() ? "value" : panel_.y.label)};
        }
        return out;
    }
    void fade(Json& encoding, double opacity) const {
        encoding["opacity"] = {{"condition", {{"param", kPick}, {"value", opacity}}},
                               {"value", opacity * 0.12}};
    }
    void add(Json data, Json mark, Json encoding) {
        mark["clip"] = true;
        layers_.push_back({{"data", std::move(data)},
                           {"mark", std::move(mark)},
                           {"encoding", std::move(encoding)}});
    }

    void add_series(const PlacedSeries& series) {
        const std::string name = one_line(layout_.looks[series.look].name);
        Json rows = Json::array();
        bool bounded = false;
        for (std::size_t r = 0; r < series.runs.size(); ++r) {
            for (const PlacedPoint& point : series.runs[r]) {
                rows.push_back(row(panel_, name, series, point, r));
                bounded = bounded || point.has_bounds;
            }
        }
        if (rows.empty()) return;
        const Json data = {{"values", rows}};
        switch (series.kind) {
            case SeriesKind::band:
                return add_band(data);
            case SeriesKind::bars:
                add_bars(data);
                if (bounded) add_strokes(data, true);
                return;
            case SeriesKind::line:
                add_line(data);
                if (bounded) add_strokes(data, false);
                // Marks that are not drawn still answer to the pointer.
                return add_points(data, series.marks);
            case SeriesKind::points:
                if (bounded) add_strokes(data, false);
                return add_points(data, true);
        }
    }
    void add_band(const Json& data) {
        Json e = encoding(true);
        e["y"]["field"] = "lo";
        e["y2"] = {{"field", "hi"}};
        e["detail"] = {{"field", "run"}, {"type", "nominal"}};
        fade(e, 0.22);
        add(data, {{"type", "area"}, {"line", false}}, e);
    }
    void add_bars(const Json& data) {
        Json e = encoding(true);
        e["x"]["field"] = "left";
        e["x2"] = {{"field", "right"}};
        e["y2"] = {{"datum", 0}};
        fade(e, 0.85);
        add(data, {{"type", "rect"}}, e);
    }
    void add_strokes(const Json& data, bool dark) {
        Json e = encoding(true);
        e["y"]["field"] = "lo";
        e["y2"] = {{"field", "hi"}};
        if (dark) e["color"] = {{"value", std::string(kTextInk.light)}};
        fade(e, 1);
        add(data, {{"type", "rule"}, {"strokeWidth", 1.5}}, e);
    }
    void add_line(const Json& data) {
        Json e = encoding(false);
        e["strokeDash"] = dash_channel(layout_);
        e["detail"] = {{"field", "run"}, {"type", "nominal"}};
        e["order"] = {{"value", nullptr}};  // as given, not sorted by x
        fade(e, 1);
        add(data, {{"type", "line"}, {"strokeWidth", 2}}, e);
    }
    void add_points(const Json& data, bool visible) {
        Json e = encoding(true);
        if (visible) {
            e["shape"] = shape_channel(layout_);
            fade(e, 1);
        } else {
            e["opacity"] = {{"value", 0}};
        }
        add(data, {{"type", "point"}, {"filled", true}, {"size", visible ? 45 : 90}}, e);
    }
    void add_references() {
        Json rows = Json::array();
        for (const ReferenceLine& line : panel_.references) {
            if (!std::isfinite(line.y)) continue;
            rows.push_back({{"series", one_line(line.name)},
                            {"y", line.y},
                            {"y_says", cell_text(TableCell(line.y), panel_.y.format, true)}});
        }
        if (rows.empty()) return;
        Json e = encoding(true);
        e.erase("x");
        e["tooltip"].erase(1);
        e["strokeDash"] = dash_channel(layout_);
        fade(e, 1);
        add({{"values", rows}}, {{"type", "rule"}, {"strokeWidth", 1.5}}, e);
    }

    const FigurePanel& panel_;
    const PanelLayout& placed_;
    const FigureLayout& layout_;
    Json layers_ = Json::array();
};

Json dark_twins(const FigureLayout& layout) {
    Json out = {{std::string(kTextInk.light), std::string(kTextInk.dark)}};
    for (const NamedLook& look : layout.looks) {
        out[std::string(look.look.ink.light)] = std::string(look.look.ink.dark);
    }
    return out;
}

}  // namespace

std::string vega_lite_spec(const Figure& figure) {
    const FigureLayout layout = layout_figure(figure);
    Json panels = Json::array();
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        Json layers = PanelSpec(figure.panels[i], layout.panels[i], layout).layers();
        if (layers.empty()) continue;
        // One layer listens to the legend; all others follow its selection.
        if (panels.empty()) layers[0]["name"] = kListener;
        panels.push_back({{"title", one_line(layout.panels[i].title)},
                          {"width", layout.columns == 1 ? kWideWidth : kNarrowWidth},
                          {"height", kHeight},
                          {"layer", std::move(layers)}});
    }
    Json out = {
        {"$schema", "https://vega.github.io/schema/vega-lite/v6.json"},
        {"description", one_line(figure.title + ". " + figure.caption)},
        {"usermeta", {{"inks", dark_twins(layout)}, {"legend", legend_looks(layout)}}},
        {"columns", layout.columns},
        {"concat", std::move(panels)},
        {"resolve",
         {{"scale", {{"color", "shared"}, {"strokeDash", "shared"}, {"shape", "shared"}}}}}};
    out["params"] = {{{"name", kPick},
                      {"select", {{"type", "point"}, {"fields", {"series"}}}},
                      {"bind", "legend"},
                      {"views", {kListener}}}};
    return out.dump();
}

}  // namespace verdigris
