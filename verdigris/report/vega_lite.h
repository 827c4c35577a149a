// SPDX-License-Identifier: MIT
// A figure as a Vega-Lite specification: the interactive twin of the drawing, from the same layout.
#pragma once

#include <string>

#include "verdigris/report/figure.h"

namespace verdigris {

/// A Vega-Lite 6 document with its data inside; it loads nothing. Same axes, ticks, colors, dashes
/// and marks as the drawing; each point's tooltip has the words that a table would have
/// (FigureAxis::format). A click on the legend dims the other series. Page scripts find in
/// usermeta.inks the dark twin of each color, and in
/// usermeta.legend the shape, size and strokeWidth of each of its entries. Throws as check_figure.
std::string vega_lite_spec(const Figure& figure);

}  // namespace verdigris
