// SPDX-License-Identifier: MIT
// One table, five readers: a spreadsheet, a program, a paper, a page and a terminal.
#pragma once

#include <string>

#include "verdigris/files/csv.h"
#include "verdigris/report/table.h"

namespace verdigris {

/// Machine precision: every number reads back bit for bit ("nan", "inf", "-inf" where it is none).
/// The header holds the ids; a column with intervals is followed by `<id>_lo` and `<id>_hi`; where
/// groups have titles they are the first column. A missing cell is empty. Percentages stay
/// fractions. Throws Error{failed} (check_table), as do all below.
CsvTable table_csv(const Table& table);

/// {"format": "verdigris-table/1", "id", "title", "caption", "note",
///  "columns": [{"id", "header", "unit": "fraction" for percentages}],
///  "rows": [{"group"?, "cells": {<id>: null | text | number | {"value", "lo", "hi"}},
///            "best"?: [<id>...]}]}
/// Full precision; NaN and infinities are null, because JSON has no word for them.
std::string table_json(const Table& table);

/// A `table` float for \usepackage{booktabs}, label "tab:<id>"; the best in bold, the note below.
/// Compiles under pdflatex without further packages, whatever the text (latex_text).
std::string table_latex(const Table& table);

/// <table id="table-<id>">, headings with scope, numbers with their value in data-value for
/// sorting. The caption and the note are inside. No script, no style.
std::string table_html(const Table& table);

/// For a terminal: caption-free, aligned, "*" after the best; ends in a newline.
std::string table_plain(const Table& table);

/// A cell in print. `typeset`: a true minus and powers of ten; otherwise ASCII for numbers.
/// "n/a", words, "0.12" or "0.12 [0.10, 0.14]".
std::string cell_text(const TableCell& cell, const NumberFormat& format, bool typeset);

}  // namespace verdigris
