// SPDX-License-Identifier: MIT
// The two formats with a language around the cells. [Booktabs] is followed: no vertical rules, and
// space instead of lines between groups.
#include <fmt/format.h>

#include <cstddef>

#include "verdigris/report/escape.h"
#include "verdigris/report/table_formats.h"

namespace verdigris {
namespace {

char latex_align(Align align) {
    return align == Align::left ? 'l' : align == Align::center ? 'c' : 'r';
}

std::string latex_cell(const TableCell& cell, const TableColumn& column) {
    const std::string text = latex_text(cell_text(cell, column.format, true));
    return cell.is_best() ? "\\textbf{" + text + "}" : text;
}

std::string html_cell(const TableCell& cell, const TableColumn& column, bool row_heading) {
    const char* align = column.align == Align::left    ? "left"
                        : column.align == Align::right ? "right"
                                                       : "center";
    std::string attributes = fmt::format(" class=\"{}{}\"", align, cell.is_best() ? " best" : "");
    // Without data-value a cell sorts as text; a missing one sorts last.
    if (cell.kind() == TableCell::Kind::number) {
        attributes += fmt::format(" data-value=\"{}\"", exact_number(cell.value()));
    } else if (cell.kind() == TableCell::Kind::missing) {
        attributes += " data-missing";
    }
    std::string text = html_text(cell_text(cell, column.format, true));
    if (cell.is_best()) text = "<strong>" + text + "</strong>";
    return row_heading ? fmt::format("<th scope=\"row\"{}>{}</th>", attributes, text)
                       : fmt::format("<td{}>{}</td>", attributes, text);
}

}  // namespace

std::string table_latex(const Table& table) {
    check_table(table);
    std::string spec, header;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        spec += latex_align(table.columns[i].align);
        header += (i > 0 ? " & " : "") + latex_text(table.columns[i].header);
    }
    std::string out = fmt::format(
        "% needs \\usepackage{{booktabs}}\n"
        "\\begin{{table}}[t]\n  \\centering\n  \\caption{{{}}}\n  \\label{{tab:{}}}\n"
        "  \\begin{{tabular}}{{{}}}\n    \\toprule\n    {} \\\\\n    \\midrule\n",
        latex_text(table.caption.empty() ? table.title : table.caption), table.id, spec, header);
    bool first = true;
    for (const RowGroup& group : table.groups) {
        if (!first) out += "    \\addlinespace\n";
        first = false;
        if (!group.title.empty()) {
            out += fmt::format("    \\multicolumn{{{}}}{{l}}{{\\emph{{{}}}}} \\\\\n",
                               table.columns.size(), latex_text(group.title));
        }
        for (const TableRow& row : group.rows) {
            out += "    ";
            for (std::size_t i = 0; i < row.size(); ++i) {
                out += (i > 0 ? " & " : "") + latex_cell(row[i], table.columns[i]);
            }
            out += " \\\\\n";
        }
    }
    out += "    \\bottomrule\n  \\end{tabular}\n";
    if (!table.note.empty()) {
        out += "  \\par\\smallskip\n  {\\footnotesize " + latex_text(table.note) + "}\n";
    }
    return out + "\\end{table}\n";
}

std::string table_html(const Table& table) {
    check_table(table);
    std::string out = fmt::format(
        "<table id=\"table-{}\">\n{}<thead><tr>", table.id,
        table.caption.empty() ? "" : "<caption>" + html_text(table.caption) + "</caption>\n");
    for (const TableColumn& column : table.columns) {
        out += fmt::format("<th scope=\"col\" class=\"{}\">{}</th>",
                           column.align == Align::left    ? "left"
                           : column.align == Align::right ? "right"
                                                          : "center",
                           html_text(column.header));
    }
    out += "</tr></thead>\n";
    for (const RowGroup& group : table.groups) {
        out += "<tbody>\n";
        if (!group.title.empty()) {
            out += fmt::format(
                "<tr class=\"group\"><th colspan=\"{}\" scope=\"rowgroup\">{}</th></tr>\n",
                table.columns.size(), html_text(group.title));
        }
        for (const TableRow& row : group.rows) {
            out += "<tr>";
            for (std::size_t i = 0; i < row.size(); ++i) {
                const bool heading = i == 0 && row[i].kind() == TableCell::Kind::words;
                out += html_cell(row[i], table.columns[i], heading);
            }
            out += "</tr>\n";
        }
        out += "</tbody>\n";
    }
    if (!table.note.empty()) {
        out += fmt::format("<tfoot><tr><td colspan=\"{}\">{}</td></tr></tfoot>\n",
                           table.columns.size(), html_text(table.note));
    }
    return out + "</table>\n";
}

}  // namespace verdigris
