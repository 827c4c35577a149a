// SPDX-License-Identifier: MIT
// The grammar is that of [RFC4180].
#include "verdigris/files/csv.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"

namespace verdigris {
namespace {

constexpr std::size_t kMaxBytes = std::size_t(64) << 20;

class Parser {
  public:
    Parser(const std::filesystem::path& path, std::string_view text) : path_(path), rest_(text) {
        constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
        if (rest_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
            rest_.remove_prefix(kByteOrderMark.size());
        }
    }

    CsvTable parse() {
        CsvTable table;
        while (!rest_.empty()) {
            const int line = line_;
            if (rest_[0] == '#') {
                skip_line();
                continue;
            }
            if (end_of_line()) continue;  // an empty line
            std::vector<std::string> cells = row();
            if (table.header.empty()) {
                table.header = std::move(cells);
                check_separator(table.header, line);
                continue;
            }
            if (cells.size() != table.header.size()) {
                refuse(line, "has " + count(cells.size()) + ", the header has " +
                                 std::to_string(table.header.size()));
            }
            table.rows.push_back(std::move(cells));
            table.lines.push_back(line);
        }
        if (table.header.empty()) {
            throw Error(ErrorCode::bad_input, "holds no table", path_.string());
        }
        return table;
    }

  private:
    static std::string count(std::size_t cells) {
        return std::to_string(cells) + (cells == 1 ? " cell" : " cells");
    }
    [[noreturn]] void refuse(int line, const std::string& what) const {
        throw Error(ErrorCode::bad_input, what, path_.string() + ", line " + std::to_string(line));
    }
    // Spreadsheets in much of Europe separate by semicolons and still call it CSV.
    void check_separator(const std::vector<std::string>& header, int line) const {
        if (header.size() != 1) return;
        for (const char c : {';', '\t'}) {
            if (header[0].find(c) != std::string::npos) {
                refuse(line, std::string("separates by ") + (c == ';' ? "semicolons" : "tabs") +
                                 "; save the table with commas");
            }
        }
    }
    void skip_line() {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size() - 1) + 1);
        ++line_;
    }
    // Consumes one line end, if there is one here: LF, CRLF, or the CR of old spreadsheets.
    bool end_of_line() {
        std::size_t length = 0;
        if (rest_[0] == '\n') length = 1;
        if (rest_[0] == '\r') length = rest_.substr(1, 1) == "\n" ? 2 : 1;
        rest_.remove_prefix(length);
        line_ += length > 0;
        return length > 0;
    }
    std::vector<std::string> row() {
        std::vector<std::string> cells;
        for (;;) {
            cells.push_back(!rest_.empty() && rest_[0] == '"' ? quoted() : plain());
            if (rest_.empty() || end_of_line()) return cells;
            rest_.remove_prefix(1);  // the comma
        }
    }
    std::string plain() {
        const std::size_t length = std::min(rest_.find_first_of(",\r\n"), rest_.size());
        std::string cell(rest_.substr(0, length));
        if (cell.find('"') != std::string::npos) refuse(line_, "has a quote inside a plain cell");
        if (cell.find('\0') != std::string::npos) refuse(line_, "is not text");
        rest_.remove_prefix(length);
        return cell;
    }
    std::string quoted() {
        const int opened = line_;
        rest_.remove_prefix(1);
        std::string cell;
        for (;;) {
            const std::size_t quote = rest_.find('"');
            if (quote == std::string_view::npos) refuse(opened, "opens a quote that never ends");
            cell += rest_.substr(0, quote);
            line_ += int(std::count(rest_.begin(), rest_.begin() + std::ptrdiff_t(quote), '\n'));
            rest_.remove_prefix(quote + 1);
            if (rest_.empty() || rest_[0] != '"') break;
            cell += '"';  // two quotes stand for one
            rest_.remove_prefix(1);
        }
        if (!rest_.empty() && rest_.find_first_of(",\r\n") != 0) {
            refuse(line_, "has text after a closing quote");
        }
        return cell;
    }

    const std::filesystem::path& path_;
    std::string_view rest_;
    int line_ = 1;
};

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

void put_row(std::string& out, const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string& cell = cells[i];
        if (i > 0) out += ',';
        // A leading # would become a comment, and a lone empty cell an empty line.
        const bool quote = cell.find_first_of(",\"\r\n") != std::string::npos ||
                           (i == 0 && (cell.empty() ? cells.size() == 1 : cell[0] == '#'));
        if (!quote) {
            out += cell;
            continue;
        }
        out += '"';
        for (const char c : cell) out.append(c == '"' ? 2 : 1, c);
        out += '"';
    }
    out += '\n';
}

}  // namespace

int CsvTable::column(std::string_view name) const {
    const std::string_view wanted = trimmed(name);
    for (std::size_t i = 0; i < header.size(); ++i) {
        const std::string_view cell = trimmed(header[i]);
        if (std::equal(cell.begin(), cell.end(), wanted.begin(), wanted.end(),
                       [](char a, char b) { return lower(a) == lower(b); })) {
            return int(i);
        }
    }
    return -1;
}

CsvTable read_csv(const std::filesystem::path& path) {
    return Parser(path, read_text(path, kMaxBytes)).parse();
}

void write_csv(const std::filesystem::path& path, const CsvTable& table) {
    std::string out;
    put_row(out, table.header);
    for (const auto& row : table.rows) {
        if (row.size() != table.header.size()) {
            throw Error(ErrorCode::failed, "is not written: a row is not as long as the header",
                        path.string());
        }
        put_row(out, row);
    }
    write_file(path, out);
}

}  // namespace verdigris
