// SPDX-License-Identifier: MIT
// What every result's tables, figures and JSON share: formats, and what stands where there is no
// number (internal).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "verdigris/evaluate/bootstrap.h"
#include "verdigris/evaluate/protocol.h"
#include "verdigris/report/figure.h"
#include "verdigris/report/table.h"
#include "verdigris/status.h"

namespace verdigris {

inline constexpr NumberFormat kError{NumberStyle::scientific, 2, false};
inline constexpr NumberFormat kGain{NumberStyle::percent, 1, true};
inline constexpr NumberFormat kCount{NumberStyle::integer, 0, false};

/// Missing where it is no number.
TableCell finite_or_missing(double value);
TableCell cell_or_missing(const std::optional<double>& value);
/// With its interval, if there is one.
TableCell interval_cell(double value, const std::optional<Interval>& interval);
FigurePoint interval_point(double x, double value, const std::optional<Interval>& interval);
/// A figure has a panel that says so where nothing could be drawn.
void never_empty(Figure& figure);

/// null where it is no number.
nlohmann::ordered_json number_json(double value);
nlohmann::ordered_json numbers_json(const std::vector<double>& values);
/// [low, high] or null.
nlohmann::ordered_json interval_json(const std::optional<Interval>& interval);
/// [{"first_start", "last_start", "windows", "gain"}]
nlohmann::ordered_json blocks_json(const std::vector<BlockGain>& blocks);
/// [{"id", "severity", "sentence"}]
nlohmann::ordered_json notes_json(const Statuses& notes);
/// {"context", "horizons", "stride", "area", "single"}
nlohmann::ordered_json protocol_json(const EvaluationProtocol& protocol);

}  // namespace verdigris
