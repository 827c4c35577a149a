// SPDX-License-Identifier: MIT
// Results to read and to cite: tables, figures and the page that holds them. Knows nothing of how
// they were found: plain data in, files out.
// Beside the path: files -> [report].
#pragma once

#include "verdigris/report/draw_figure.h"
#include "verdigris/report/figure.h"
#include "verdigris/report/number_text.h"
#include "verdigris/report/page.h"
#include "verdigris/report/table.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/report/vega_lite.h"
#include "verdigris/report/write_results.h"
