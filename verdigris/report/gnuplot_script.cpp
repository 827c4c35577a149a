// SPDX-License-Identifier: MIT
#include "verdigris/report/gnuplot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <vector>

#include "verdigris/report/escape.h"
#include "verdigris/report/figure_layout.h"

namespace verdigris {
namespace {

// Inches. A column of a two-column paper, and the whole width of its page.
constexpr double kColumnWidth = 3.5, kPanelHeight = 2.3, kTitleHeight = 0.16;
constexpr double kSvgPerInch = 96, kPngPerInch = 300;
constexpr double kPointsPerInch = 72, kFontPoints = 7.5, kLinePoints = 0.8;
constexpr double kPangoPoint = 0.75;  // Pango draws a point as 4/3 pixels, whatever the scale
constexpr double kLegendLine = 0.15;
// DejaVu Sans: the mean letter of English words takes 0.62 of the font's size, a digit 0.64.
constexpr double kLetterWidth = 0.65 * kFontPoints / kPointsPerInch;
// What the labels and the tics of the y axis take of a panel.
constexpr double kAxisShare = 0.18;
constexpr double kSlant = 35;  // degrees, of names that do not fit

struct Sheet {
    double width = 0, height = 0, legend = 0;  // inches
    int legend_columns = 1, rows = 1, columns = 1;
};

std::string terminal(const Sheet& sheet, FigureFormat format) {
    if (format == FigureFormat::svg) {
        // gnuplot's svg counts fonts in px.
        return fmt::format(
            "set terminal svg size {:.0f},{:.0f} fixed noenhanced font 'DejaVu Sans,{:.2f}' "
            "linewidth {:.2f} background '#ffffff'\n",
            sheet.width * kSvgPerInch, sheet.height * kSvgPerInch,
            kFontPoints * kSvgPerInch / kPointsPerInch, kLinePoints * kSvgPerInch / kPointsPerInch);
    }
    const double scale = kPngPerInch / kPointsPerInch;
    return fmt::format(
        "set terminal pngcairo size {:.0f},{:.0f} noenhanced font 'DejaVu Sans,{:.2f}' "
        "fontscale {:.4f} dashlength 1.5 linewidth {:.2f} pointscale {:.2f} background '#ffffff'\n",
        sheet.width * kPngPerInch, sheet.height * kPngPerInch, kFontPoints, scale * kPangoPoint,
        kLinePoints * scale, scale);
}

std::string dash_type(std::span<const double> dash) {
    if (dash.empty()) return "solid";
    std::string out = "(";
    for (std::size_t i = 0; i < dash.size(); ++i)
        out += fmt::format("{}{}", i > 0 ? "," : "", dash[i]);
    return out + ")";
}

std::string line_style(const SeriesLook& look) {
    return fmt::format("lc rgb '{}' lw 1.4 dt {}", look.ink.light, dash_type(look.dash));
}
std::string mark_style(const SeriesLook& look) {
    return fmt::format("lc rgb '{}' lw 1 dt solid pt {} ps 0.45", look.ink.light,
                       look.shape.gnuplot);
}
std::string fill_style(const SeriesLook& look, double opacity) {
    return fmt::format("lc rgb '{}' fs transparent solid {} noborder", look.ink.light, opacity);
}
std::string reference_style() {
    return fmt::format("lc rgb '{}' lw 1.1 dt (4,2.5)", kTextInk.light);
}

// The data of one plot element as an inline block; runs are parted by an empty line, at which
// gnuplot lifts its pen.
class Blocks {
  public:
    template <class Row>
    std::string add(const PlacedSeries& series, Row row) {
        const std::string name = fmt::format("$d{}", count_++);
        text_ += name + " << END\n";
        for (std::size_t r = 0; r < series.runs.size(); ++r) {
            if (r > 0) text_ += "\n";
            for (const PlacedPoint& point : series.runs[r]) text_ += row(point) + "\n";
        }
        text_ += "END\n";
        return name;
    }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
    int count_ = 0;
};

std::string numbers(std::initializer_list<double> values) {
    std::string out;
    for (const double v : values) out += (out.empty() ? "" : " ") + exact_number(v);
    return out;
}

// A series as elements of the plot command, from back to front.
void add_elements(std::vector<std::string>& back, std::vector<std::string>& front, Blocks& blocks,
                  const PlacedSeries& series, const SeriesLook& look, double xu, double yu) {
    if (series.runs.empty()) return;
    const auto element = [](const std::string& block, const std::string& what) {
        return block + " " + what + " notitle";
    };
    const bool bounded = std::any_of(series.runs.begin(), series.runs.end(), [](const auto& run) {
        return std::any_of(run.begin(), run.end(),
                           [](const PlacedPoint& p) { return p.has_bounds; });
    });
    if (series.kind == SeriesKind::band) {
        const std::string block = blocks.add(series, [&](const PlacedPoint& p) {
            return numbers({p.x * xu, p.lo * yu, p.hi * yu});
        });
        back.push_back(element(block, "using 1:2:3 with filledcurves " + fill_style(look, 0.22)));
        return;
    }
    const std::string block = blocks.add(series, [&](const PlacedPoint& p) {
        return numbers(
            {p.x * xu, p.y * yu, p.lo * yu, p.hi * yu, 2 * series.half_width * xu * 0.92});
    });
    // Strokes, not gnuplot's error bars: those clear a halo around their mark.
    const auto strokes = [&](std::string_view color) {
        return element(block, fmt::format("using 1:3:(0):($4-$3) with vectors nohead lc rgb '{}' "
                                          "lw 1 dt solid",
                                          color));
    };
    if (series.kind == SeriesKind::bars) {
        back.push_back(element(block, "using 1:2:5 with boxes " + fill_style(look, 0.85)));
        if (bounded) front.push_back(strokes(kTextInk.light));
        return;
    }
    if (bounded) front.push_back(strokes(look.ink.light));
    if (series.kind == SeriesKind::line) {
        front.push_back(element(block, "using 1:2 with lines " + line_style(look)));
    }
    if (series.marks || series.kind == SeriesKind::points) {
        front.push_back(element(block, "using 1:2 with points " + mark_style(look)));
    }
}

std::string legend_entry(const NamedLook& entry) {
    const std::string title = " title " + gnuplot_quoted(entry.name);
    if (entry.bars) return "keyentry with boxes " + fill_style(entry.look, 0.85) + title;
    if (entry.line && entry.marks) {
        return "keyentry with linespoints " + line_style(entry.look) +
               fmt::format(" pt {} ps 0.45", entry.look.shape.gnuplot) + title;
    }
    if (entry.line) return "keyentry with lines " + line_style(entry.look) + title;
    if (entry.marks) return "keyentry with points " + mark_style(entry.look) + title;
    return "keyentry with filledcurves " + fill_style(entry.look, 0.3) + title;
}

std::string legend(const FigureLayout& layout, const Sheet& sheet) {
    const double share = sheet.legend / sheet.height;
    std::string out = fmt::format(
        "set origin 0,{:.6f}\nset size 1,{:.6f}\nunset border\nunset tics\nunset grid\n"
        "unset title\nunset xlabel\nunset ylabel\nunset logscale\n"
        "set lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n"
        "set xrange [0:1]\nset yrange [0:1]\n"
        "set key at screen 0.5,{:.6f} center center horizontal Left reverse maxcols {} "
        "samplen 2 width -3 spacing 1.0 textcolor rgb '{}'\n"
        "plot NaN notitle",
        1 - share, share, 1 - share / 2, sheet.legend_columns, kTextInk.light);
    for (const NamedLook& look : layout.looks) out += ", \\\n  " + legend_entry(look);
    for (const std::string& name : layout.references) {
        out +=
            ", \\\n  keyentry with lines " + reference_style() + " title " + gnuplot_quoted(name);
    }
    return out + "\n";
}

// gnuplot reads the label of a tic as a format, unlike any other text.
std::string tic_label(const std::string& text) {
    std::string out;
    for (const char c : text) out.append(c == '%' ? 2 : 1, c);
    return gnuplot_quoted(out);
}

// Names of files are long; what tells them apart is mostly at the ends.
std::string shortened(const std::string& name) {
    constexpr int kMost = 16;
    if (character_count(name) <= kMost) return one_line(name);
    return first_characters(name, kMost - 8) + "…" + last_characters(name, 7);
}

// Inches that slanted names take below the axis; 0 where they fit beside each other.
double slanted_depth(const FigurePanel& panel) {
    if (panel.x.categories.empty()) return 0;
    double widest = 0;
    for (const std::string& name : panel.x.categories) {
        widest = std::max(widest, character_count(shortened(name)) * kLetterWidth);
    }
    const double room = kColumnWidth * (1 - kAxisShare) / double(panel.x.categories.size());
    return widest < room * 0.95 ? 0 : widest * std::sin(kSlant * std::numbers::pi / 180);
}

double panel_height(const Figure& figure, const FigureLayout& layout) {
    double title = 0, names = 0;
    for (const PanelLayout& panel : layout.panels) {
        if (!panel.title.empty()) title = kTitleHeight;
    }
    for (const FigurePanel& panel : figure.panels) names = std::max(names, slanted_depth(panel));
    return kPanelHeight + title + names;
}

Sheet sheet_of(const Figure& figure, const FigureLayout& layout) {
    Sheet sheet;
    sheet.columns = layout.columns;
    sheet.rows = (int(layout.panels.size()) + sheet.columns - 1) / sheet.columns;
    sheet.width = kColumnWidth * sheet.columns;
    if (layout.has_legend()) {
        int widest = 0;
        for (const NamedLook& look : layout.looks) {
            widest = std::max(widest, character_count(look.name));
        }
        for (const std::string& name : layout.references) {
            widest = std::max(widest, character_count(name));
        }
        const int entries = int(layout.looks.size() + layout.references.size());
        // As gnuplot's svg counts, which takes a letter for wider than it is. An entry that it
        // thinks does not fit would start a line for which there is no room: `width` below.
        const double entry = (widest + 4.5) * 0.7 * kFontPoints / kPointsPerInch;
        const int fit = std::clamp(int(sheet.width / entry), 1, entries);
        const int lines = (entries + fit - 1) / fit;
        sheet.legend_columns = (entries + lines - 1) / lines;  // no lonely last entry
        sheet.legend = lines * kLegendLine + 0.08;
    }
    sheet.height = sheet.legend + sheet.rows * panel_height(figure, layout);
    return sheet;
}

std::string category_tics(const FigurePanel& panel) {
    std::string out;
    const std::vector<std::string>& names = panel.x.categories;
    for (std::size_t i = 0; i < names.size(); ++i) {
        out += fmt::format("{}{} {}", i > 0 ? ", " : "", tic_label(shortened(names[i])), i);
    }
    const std::string turn = slanted_depth(panel) > 0
                                 ? fmt::format("rotate by {} right offset 0.8,0.2", kSlant)
                                 : "norotate autojustify offset 0,0.35";
    return fmt::format("set xtics {} scale 0 ({})\n", turn, out);
}

std::string tics(const char* axis, const AxisSpan& span) {
    std::string out;
    for (const AxisTick& tick : span.ticks) {
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ", tic_label(tick.label),
                           exact_number(tick.at * span.unit));
    }
    return fmt::format("set {0}tics norotate autojustify scale 0.5 offset {2} ({1})\n", axis, out,
                       *axis == 'x' ? "0,0.35" : "0.4,0");
}

std::string axis_lines(const char* name, const FigureAxis& axis, const AxisSpan& span) {
    return fmt::format("set {0}label {1}\nset {0}range [{2}:{3}]\n{4} {0}\n", name,
                       gnuplot_quoted(axis.label), exact_number(span.lo * span.unit),
                       exact_number(span.hi * span.unit),
                       axis.scale == AxisScale::log10 ? "set logscale" : "unset logscale") +
           tics(name, span);
}

std::string panel(const FigurePanel& given, const PanelLayout& placed, const FigureLayout& layout,
                  const Sheet& sheet, std::size_t index, Blocks& blocks) {
    const double top = 1 - sheet.legend / sheet.height;
    const double height = top / sheet.rows, width = 1.0 / sheet.columns;
    const std::size_t columns = std::size_t(sheet.columns), whole_rows = index / columns;
    const auto row = double(whole_rows), column = double(index % columns);
    std::string out = fmt::format("set origin {:.6f},{:.6f}\nset size {:.6f},{:.6f}\n",
                                  column * width, top - (row + 1) * height, width, height);
    out += "set title " + gnuplot_quoted(placed.title) + "\n";
    out += axis_lines("y", given.y, placed.y);
    out += axis_lines("x", given.x, placed.x);
    if (!given.x.categories.empty()) out += category_tics(given);
    const double xu = placed.x.unit, yu = placed.y.unit;
    std::vector<std::string> back, references, front;
    for (const ReferenceLine& line : given.references) {
        if (std::isfinite(line.y)) {
            references.push_back(exact_number(line.y * yu) + " with lines " + reference_style() +
                                 " notitle");
        }
    }
    for (const PlacedSeries& series : placed.series) {
        add_elements(back, front, blocks, series, layout.looks[series.look].look, xu, yu);
    }
    std::vector<std::string> all = std::move(back);
    all.insert(all.end(), references.begin(), references.end());
    all.insert(all.end(), front.begin(), front.end());
    if (all.empty()) all.push_back("NaN notitle");
    out += "plot ";
    for (std::size_t i = 0; i < all.size(); ++i) out += (i > 0 ? ", \\\n  " : "") + all[i];
    return out + "\n";
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : one_line(text)) out.append(c == '\'' ? 2 : 1, c);
    return out + "'";
}

std::string gnuplot_script(const Figure& figure, FigureFormat format) {
    const FigureLayout layout = layout_figure(figure);
    const Sheet sheet = sheet_of(figure, layout);
    Blocks blocks;
    std::string panels;
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        panels += panel(figure.panels[i], layout.panels[i], layout, sheet, i, blocks);
    }
    std::string out = "set encoding utf8\nset minussign\nset samples 2\n";
    out += terminal(sheet, format) + blocks.text();
    out += fmt::format(
        "set border 3 lc rgb '{0}' lw 0.8\nset tics nomirror out textcolor rgb '{0}'\n"
        "set grid ytics lt 1 lc rgb '{1}' lw 0.6 dt solid\nset title textcolor rgb '{0}' offset "
        "0,-0.4\n"
        "set xlabel textcolor rgb '{0}' offset 0,0.7\nset ylabel textcolor rgb '{0}'\n"
        "set rmargin 2.5\nset key off\nset multiplot\n",
        kTextInk.light, kGridInk.light);
    out += panels;
    if (layout.has_legend()) out += legend(layout, sheet);
    return out + "unset multiplot\n";
}

}  // namespace verdigris
