// SPDX-License-Identifier: MIT
#include "verdigris/results/cells.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace verdigris {
using Json = nlohmann::ordered_json;

TableCell finite_or_missing(double value) {
    return std::isfinite(value) ? TableCell(value) : TableCell();
}

TableCell cell_or_missing(const std::optional<double>& value) {
    return value ? finite_or_missing(*value) : TableCell();
}

TableCell interval_cell(double value, const std::optional<Interval>& interval) {
    if (!std::isfinite(value)) return {};
    return interval ? TableCell(value, {interval->low, interval->high}) : TableCell(value);
}

FigurePoint interval_point(double x, double value, const std::optional<Interval>& interval) {
    FigurePoint point{x, value};
    if (interval) point.bounds = Bounds{interval->low, interval->high};
    return point;
}

void never_empty(Figure& figure) {
    if (!figure.panels.empty()) return;
    figure.panels.emplace_back();
    figure.panels.back().title = "no window was scored";
}

Json number_json(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json numbers_json(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double v : values) list.push_back(number_json(v));
    return list;
}

Json interval_json(const std::optional<Interval>& interval) {
    return interval ? Json{number_json(interval->low), number_json(interval->high)} : Json(nullptr);
}

Json blocks_json(const std::vector<BlockGain>& blocks) {
    Json list = Json::array();
    for (const BlockGain& b : blocks)
        list.push_back({{"first_start", b.first_start},
                        {"last_start", b.last_start},
                        {"windows", b.windows},
                        {"gain", number_json(b.value)}});
    return list;
}

Json notes_json(const Statuses& notes) {
    Json list = Json::array();
    for (const Status& s : notes)
        list.push_back(
            {{"id", s.id}, {"severity", to_string(s.severity)}, {"sentence", s.sentence}});
    return list;
}

Json protocol_json(const EvaluationProtocol& p) {
    return {{"context", p.context},
            {"horizons", p.horizons},
            {"stride", p.stride},
            {"area", to_string(p.area)},
            {"single", p.single}};
}

}  // namespace verdigris
