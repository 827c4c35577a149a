// SPDX-License-Identifier: MIT
// A figure as pictures, drawn by gnuplot (Debian's gnuplot-nox) in a process of its own.
#pragma once

#include <string>

#include "verdigris/report/figure.h"
#include "verdigris/report/gnuplot_script.h"

namespace verdigris {

/// Is there a gnuplot on PATH? Without one results are written without figures.
bool gnuplot_is_installed();

/// The bytes of the picture. Same figure, same bytes, given the same gnuplot and fonts. Throws
/// Error{failed}: no gnuplot (the sentence says what to install), it failed (with its complaint) or
/// took over a minute; and as check_figure. Cost: one process, about 0.1 s.
std::string draw_figure(const Figure& figure, FigureFormat format);

}  // namespace verdigris
