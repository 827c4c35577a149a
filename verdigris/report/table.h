// SPDX-License-Identifier: MIT
// A table as plain data: what table_formats.h writes and page.h shows.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "verdigris/report/number_text.h"

namespace verdigris {

/// The ends of an interval around a number: of confidence, of a range; the caption says which.
struct Bounds {
    double lo = 0, hi = 0;
};

/// One cell: nothing ("n/a"), words, a number, or a number with its interval. A string literal, a
/// std::string and any arithmetic type convert; `TableCell{}` is missing. NaN is not missing: it
/// is a computation that failed, and is shown as such.
class TableCell {
  public:
    enum class Kind { missing, words, number };

    TableCell() = default;
    TableCell(std::string words) : kind_(Kind::words), words_(std::move(words)) {}
    TableCell(const char* words) : TableCell(std::string(words)) {}
    template <class Number>
    requires(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>) TableCell(Number value)
        : kind_(Kind::number), value_(double(value)) {}
    TableCell(double value, Bounds bounds) : kind_(Kind::number), value_(value), bounds_(bounds) {}

    /// Marked as the best of its column: bold, "*" in plain text.
    TableCell best() && {
        best_ = true;
        return std::move(*this);
    }
    void set_best(bool best) { best_ = best; }

    Kind kind() const { return kind_; }
    const std::string& words() const { return words_; }
    double value() const { return value_; }
    const std::optional<Bounds>& bounds() const { return bounds_; }
    bool is_best() const { return best_; }

  private:
    Kind kind_ = Kind::missing;
    std::string words_;
    double value_ = 0;
    std::optional<Bounds> bounds_;
    bool best_ = false;
};

enum class Align { left, right, center };

struct TableColumn {
    std::string id;      ///< key in CSV and JSON: letters, digits, "-", "_"; unique
    std::string header;  ///< what the reader sees; UTF-8, one line
    Align align = Align::right;
    NumberFormat format{};  ///< of the numbers and the ends of intervals
    /// CSV carries `<id>_lo` and `<id>_hi` also where no cell has an interval, so that the header
    /// does not depend on the data.
    bool interval = false;
};

using TableRow = std::vector<TableCell>;  ///< as many as there are columns

struct RowGroup {
    std::string title;  ///< empty: no heading
    std::vector<TableRow> rows;
};

struct Table {
    std::string id;       ///< file name and label: letters, digits, "-", "_"
    std::string title;    ///< a few words: the table of contents, the heading
    std::string caption;  ///< what is shown, in which unit, what the intervals are
    std::string note;     ///< below the table; may be empty
    std::vector<TableColumn> columns;
    std::vector<RowGroup> groups;
    /// Heading of the column that names the groups in CSV.
    std::string group_header = "group";

    /// Appends to the last group; makes an untitled one where there is none.
    void add_row(TableRow row);
    /// Does a cell of this column, or its declaration, carry an interval?
    bool has_interval(int column) const;
    bool has_group_titles() const;
};

/// Throws Error{failed} naming the table: an id that is no plain id or is used twice, a row that is
/// not as long as the header, no column at all. Every writer calls it.
void check_table(const Table& table);

enum class Better { lower, higher };

/// Marks the best finite number of a column within each group (all that tie, bit for bit) and
/// unmarks the rest. Throws Error{failed} for a column that is not there.
void mark_best(Table& table, const std::string& column_id, Better better);

}  // namespace verdigris
