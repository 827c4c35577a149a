// SPDX-License-Identifier: MIT
// times.csv: when each frame was taken, as the user wrote it down. Columns `time` (seconds or
// ISO 8601) and `file` or `frame` (counted from 0); with `time` alone, one row per frame in order.
// Internal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/files/csv.h"

namespace verdigris {

class TimesCsv {
  public:
    /// Throws Error{bad_input} naming file and line: no column `time`, a time that is none.
    explicit TimesCsv(const std::filesystem::path& path);

    /// A time for each of `frames` frames. Rows for frames from `frames` up to `announced` are
    /// left out: a recording that was cut off has fewer frames than its table.
    /// Throws Error{bad_input} naming file and line: an unknown, repeated or missing frame.
    std::vector<double> by_frame(int frames, int announced) const;
    /// A time for each file name. Throws as by_frame; a name that is not there is an error too.
    std::vector<double> by_file(const std::vector<std::string>& names) const;

    const std::filesystem::path& path() const { return path_; }

  private:
    [[noreturn]] void refuse(std::size_t row, const std::string& sentence) const;
    std::vector<double> in_order(int frames, int announced) const;

    std::filesystem::path path_;
    CsvTable table_;
    std::vector<double> seconds_;  // by row
    int file_ = -1, frame_ = -1;   // columns
};

/// How many steps of `times` run backwards.
int backward_steps(const std::vector<double>& times);
/// True if the steps of `times` differ by more than 1 % and by more than one `tick` of the clock
/// that made them.
bool has_variable_rate(const std::vector<double>& times, double tick);

}  // namespace verdigris
