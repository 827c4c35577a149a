// SPDX-License-Identifier: MIT
#include "verdigris/report/table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include "verdigris/error.h"
#include "verdigris/report/escape.h"

namespace verdigris {
namespace {

[[noreturn]] void refuse(const Table& table, const std::string& what) {
    throw Error(ErrorCode::failed, what, "table '" + table.id + "'");
}

bool counts(const TableCell& cell) {
    return cell.kind() == TableCell::Kind::number && std::isfinite(cell.value());
}

void mark_best_of(RowGroup& group, std::size_t column, Better better) {
    const TableCell* best = nullptr;
    for (const TableRow& row : group.rows) {
        const TableCell& cell = row[column];
        if (!counts(cell)) continue;
        const bool wins = !best || (better == Better::lower ? cell.value() < best->value()
                                                            : cell.value() > best->value());
        if (wins) best = &cell;
    }
    for (TableRow& row : group.rows) {
        TableCell& cell = row[column];
        cell.set_best(best && counts(cell) && cell.value() == best->value());
    }
}

}  // namespace

void Table::add_row(TableRow row) {
    if (groups.empty()) groups.emplace_back();
    groups.back().rows.push_back(std::move(row));
}

bool Table::has_interval(int column) const {
    const auto at = std::size_t(column);
    if (columns[at].interval) return true;
    for (const RowGroup& group : groups) {
        for (const TableRow& row : group.rows) {
            if (row[at].bounds()) return true;
        }
    }
    return false;
}

bool Table::has_group_titles() const {
    return std::any_of(groups.begin(), groups.end(),
                       [](const RowGroup& group) { return !group.title.empty(); });
}

void check_table(const Table& table) {
    if (!is_plain_id(table.id)) {
        refuse(table, "is not written: its id must be letters, digits, '-' and '_' only");
    }
    if (table.columns.empty()) refuse(table, "is not written: it has no column");
    std::set<std::string> keys;
    if (table.has_group_titles()) keys.insert(table.group_header);
    const auto claim = [&](const std::string& key) {
        if (!keys.insert(key).second) {
            refuse(table, "is not written: two of its columns are called '" + key + "'");
        }
    };
    for (const TableColumn& column : table.columns) {
        if (!is_plain_id(column.id)) {
            refuse(table, "is not written: the column id '" + column.id +
                              "' must be letters, digits, '-' and '_' only");
        }
        claim(column.id);
    }
    for (const RowGroup& group : table.groups) {
        for (const TableRow& row : group.rows) {
            if (row.size() != table.columns.size()) {
                refuse(table, "is not written: a row has " + std::to_string(row.size()) +
                                  " cells, the header has " + std::to_string(table.columns.size()));
            }
        }
    }
    // Only now, because it looks into the rows.
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        if (!table.has_interval(int(i))) continue;
        claim(table.columns[i].id + "_lo");
        claim(table.columns[i].id + "_hi");
    }
}

void mark_best(Table& table, const std::string& column_id, Better better) {
    check_table(table);
    const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                    [&](const TableColumn& c) { return c.id == column_id; });
    if (found == table.columns.end()) refuse(table, "has no column '" + column_id + "'");
    const auto column = std::size_t(found - table.columns.begin());
    for (RowGroup& group : table.groups) mark_best_of(group, column, better);
}

}  // namespace verdigris
