// SPDX-License-Identifier: MIT
// Small tables: times.csv, optical constants, results.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace verdigris {

/// RFC 4180 with `#` comment lines, CRLF or LF, quoted fields, a UTF-8 byte-order mark allowed.
/// `header` is the first row. Every row has as many cells as the header.
struct CsvTable {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
    std::vector<int> lines;  ///< line number of each row, from 1, for error messages

    /// Index of a column by name (case-insensitive), -1 if absent.
    int column(std::string_view name) const;
};

/// Throws Error{bad_input} naming the file and the line. Files over 64 MB are refused.
CsvTable read_csv(const std::filesystem::path& path);

/// Quotes where needed; rows end in "\n". Throws Error{failed}.
void write_csv(const std::filesystem::path& path, const CsvTable& table);

/// "2026-03-01T12:00:00.5+02:00", "2026-03-01 12:00:00", "2026:03:01 12:00:00" (EXIF) or a plain
/// number of seconds. Returns seconds since 1970 (or the plain number). No zone means UTC.
/// Throws Error{bad_input} quoting the text.
double seconds_from_text(std::string_view text);

}  // namespace verdigris
