// SPDX-License-Identifier: MIT
// A figure as a script for gnuplot 5.4 or later, complete with its data.
#pragma once

#include <string>

#include "verdigris/report/figure.h"

namespace verdigris {

enum class FigureFormat {
    svg,  ///< 96 px to the inch, scalable
    png,  ///< 300 px to the inch, on white
};

/// The script draws to standard output. Fixed font (DejaVu Sans, 7.5 pt), fixed order, no date:
/// same figure, same bytes. Text of the figure is quoted so that it is never read as a command.
/// Throws as check_figure.
std::string gnuplot_script(const Figure& figure, FigureFormat format);

/// `text` as a string in single quotes, in which gnuplot expands nothing.
std::string gnuplot_quoted(const std::string& text);

}  // namespace verdigris
