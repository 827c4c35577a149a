// SPDX-License-Identifier: MIT
// What the tests of this room share.
#pragma once

#include <string>

#include "verdigris/report/figure.h"

namespace verdigris {

/// One panel, one line over three points: (0, 1), (1, 10), (2, 100).
inline Figure simple_figure() {
    FigurePanel panel;
    panel.x.label = "Horizon";
    panel.y.label = "Error";
    panel.series = {{"affinergb", SeriesKind::line, {{0, 1}, {1, 10}, {2, 100}}}};
    return {"simple", "A simple figure", "Only a line.", {panel}};
}

}  // namespace verdigris
