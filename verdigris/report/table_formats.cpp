// SPDX-License-Identifier: MIT
#include "verdigris/report/table_formats.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "verdigris/report/escape.h"

namespace verdigris {
namespace {

using Json = nlohmann::ordered_json;

// nlohmann writes null for what is not finite, which is what is wanted; said here so that it does
// not hang on a library's habit.
Json json_number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_cell(const TableCell& cell) {
    switch (cell.kind()) {
        case TableCell::Kind::missing:
            return nullptr;
        case TableCell::Kind::words:
            return one_line(cell.words());
        case TableCell::Kind::number:
            break;
    }
    if (!cell.bounds()) return json_number(cell.value());
    return {{"value", json_number(cell.value())},
            {"lo", json_number(cell.bounds()->lo)},
            {"hi", json_number(cell.bounds()->hi)}};
}

void append_csv_cell(std::vector<std::string>& out, const TableCell& cell, bool interval) {
    switch (cell.kind()) {
        case TableCell::Kind::missing:
            out.emplace_back();
            break;
        case TableCell::Kind::words:
            out.push_back(one_line(cell.words()));
            break;
        case TableCell::Kind::number:
            out.push_back(exact_number(cell.value()));
            break;
    }
    if (!interval) return;
    out.push_back(cell.bounds() ? exact_number(cell.bounds()->lo) : "");
    out.push_back(cell.bounds() ? exact_number(cell.bounds()->hi) : "");
}

void pad(std::string& line, const std::string& text, int width, Align align) {
    const int room = std::max(width - character_count(text), 0);
    const int before = align == Align::left ? 0 : align == Align::right ? room : room / 2;
    line.append(std::size_t(before), ' ');
    line += text;
    line.append(std::size_t(room - before), ' ');
}

void end_line(std::string& out, std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
}

}  // namespace

std::string cell_text(const TableCell& cell, const NumberFormat& format, bool typeset) {
    if (cell.kind() == TableCell::Kind::missing) return "n/a";
    if (cell.kind() == TableCell::Kind::words) return one_line(cell.words());
    const auto text = [&](double v) {
        return typeset ? typeset_number(v, format) : number_text(v, format);
    };
    if (!cell.bounds()) return text(cell.value());
    return text(cell.value()) + " [" + text(cell.bounds()->lo) + ", " + text(cell.bounds()->hi) +
           "]";
}

CsvTable table_csv(const Table& table) {
    check_table(table);
    CsvTable out;
    const bool grouped = table.has_group_titles();
    std::vector<bool> interval;
    if (grouped) out.header.push_back(table.group_header);
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const std::string& id = table.columns[i].id;
        interval.push_back(table.has_interval(int(i)));
        out.header.push_back(id);
        if (!interval.back()) continue;
        out.header.push_back(id + "_lo");
        out.header.push_back(id + "_hi");
    }
    for (const RowGroup& group : table.groups) {
        for (const TableRow& row : group.rows) {
            std::vector<std::string> cells;
            if (grouped) cells.push_back(one_line(group.title));
            for (std::size_t i = 0; i < row.size(); ++i)
                append_csv_cell(cells, row[i], interval[i]);
            out.rows.push_back(std::move(cells));
        }
    }
    return out;
}

std::string table_json(const Table& table) {
    check_table(table);
    Json out = {{"format", "verdigris-table/1"},
                {"id", table.id},
                {"title", one_line(table.title)},
                {"caption", one_line(table.caption)},
                {"note", one_line(table.note)}};
    Json columns = Json::array(), rows = Json::array();
    for (const TableColumn& column : table.columns) {
        Json entry = {{"id", column.id}, {"header", one_line(column.header)}};
        if (column.format.style == NumberStyle::percent) entry["unit"] = "fraction";
        columns.push_back(std::move(entry));
    }
    for (const RowGroup& group : table.groups) {
        for (const TableRow& row : group.rows) {
            Json entry = Json::object(), cells = Json::object(), best = Json::array();
            if (!group.title.empty()) entry["group"] = one_line(group.title);
            for (std::size_t i = 0; i < row.size(); ++i) {
                cells[table.columns[i].id] = json_cell(row[i]);
                if (row[i].is_best()) best.push_back(table.columns[i].id);
            }
            entry["cells"] = std::move(cells);
            if (!best.empty()) entry["best"] = std::move(best);
            rows.push_back(std::move(entry));
        }
    }
    out["columns"] = std::move(columns);
    out["rows"] = std::move(rows);
    return out.dump(2) + "\n";
}

std::string table_plain(const Table& table) {
    check_table(table);
    // Where a column marks its best, the rest leave the room of the mark, so that digits line up.
    std::vector<bool> marks(table.columns.size());
    for (const RowGroup& group : table.groups) {
        for (const TableRow& row : group.rows) {
            for (std::size_t i = 0; i < row.size(); ++i) marks[i] = marks[i] || row[i].is_best();
        }
    }
    const auto text = [&](const TableRow& row, std::size_t i) {
        return cell_text(row[i], table.columns[i].format, false) + (row[i].is_best() ? "*"
                                                                    : marks[i]       ? " "
                                                                                     : "");
    };
    std::vector<int> width;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        int widest = character_count(one_line(table.columns[i].header));
        for (const RowGroup& group : table.groups) {
            for (const TableRow& row : group.rows) {
                widest = std::max(widest, character_count(text(row, i)));
            }
        }
        width.push_back(widest);
    }
    std::string out, line, rule;
    for (std::size_t i = 0; i < width.size(); ++i) {
        if (i > 0) line += "  ", rule += "  ";
        pad(line, one_line(table.columns[i].header), width[i], table.columns[i].align);
        rule.append(std::size_t(width[i]), '-');
    }
    end_line(out, line);
    end_line(out, rule);
    for (const RowGroup& group : table.groups) {
        if (!group.title.empty()) end_line(out, one_line(group.title) + ":");
        for (const TableRow& row : group.rows) {
            line.clear();
            for (std::size_t i = 0; i < row.size(); ++i) {
                if (i > 0) line += "  ";
                pad(line, text(row, i), width[i], table.columns[i].align);
            }
            end_line(out, line);
        }
    }
    if (!table.note.empty()) end_line(out, one_line(table.note));
    return out;
}

}  // namespace verdigris
