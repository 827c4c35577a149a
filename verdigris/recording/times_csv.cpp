// SPDX-License-Identifier: MIT
#include "verdigris/recording/times_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "verdigris/error.h"

namespace verdigris {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TimesCsv::TimesCsv(const std::filesystem::path& path) : path_(path), table_(read_csv(path)) {
    file_ = table_.column("file");
    frame_ = table_.column("frame");
    const int time = table_.column("time");
    if (time < 0) {
        throw Error(ErrorCode::bad_input, "has no column 'time' in its first line", path.string());
    }
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
        try {
            seconds_.push_back(seconds_from_text(table_.rows[row][std::size_t(time)]));
        } catch (const Error& error) {
            refuse(row, error.sentence());
        }
        if (!std::isfinite(seconds_.back())) refuse(row, "the time is not a finite number");
    }
}

void TimesCsv::refuse(std::size_t row, const std::string& sentence) const {
    throw Error(ErrorCode::bad_input, sentence,
                path_.string() + ", line " + std::to_string(table_.lines[row]));
}

std::vector<double> TimesCsv::in_order(int frames, int announced) const {
    const std::size_t rows = seconds_.size();
    if (rows < std::size_t(frames) || rows > std::size_t(std::max(frames, announced))) {
        throw Error(
            ErrorCode::bad_input,
            "has " + std::to_string(rows) + " times for " + std::to_string(frames) + " frames",
            path_.string());
    }
    return {seconds_.begin(), seconds_.begin() + frames};
}

std::vector<double> TimesCsv::by_frame(int frames, int announced) const {
    if (frame_ < 0) {
        if (file_ >= 0) {
            throw Error(ErrorCode::bad_input,
                        "names files, but the recording is a video; use a column 'frame'",
                        path_.string());
        }
        return in_order(frames, announced);
    }
    std::vector<double> times(std::size_t(frames), kNone);
    for (std::size_t row = 0; row < seconds_.size(); ++row) {
        const std::string& cell = table_.rows[row][std::size_t(frame_)];
        int number = -1;
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
        if (error != std::errc() || end != cell.data() + cell.size() || number < 0) {
            refuse(row, "'" + cell + "' is not the number of a frame (0, 1, 2 ...)");
        }
        if (number >= frames && number < announced) continue;
        if (number >= frames) {
            refuse(row, "there is no frame " + cell + ": the recording has " +
                            std::to_string(frames) + ", counted from 0");
        }
        if (!std::isnan(times[std::size_t(number)])) refuse(row, "frame " + cell + " comes twice");
        times[std::size_t(number)] = seconds_[row];
    }
    const auto missing =
        std::find_if(times.begin(), times.end(), [](double t) { return std::isnan(t); });
    if (missing != times.end()) {
        const auto count =
            std::count_if(missing, times.end(), [](double t) { return std::isnan(t); });
        throw Error(ErrorCode::bad_input,
                    "has no row for frame " + std::to_string(missing - times.begin()) +
                        (count > 1 ? " and " + std::to_string(count - 1) + " more" : ""),
                    path_.string());
    }
    return times;
}

std::vector<double> TimesCsv::by_file(const std::vector<std::string>& names) const {
    if (file_ < 0) return by_frame(int(names.size()), int(names.size()));
    std::unordered_map<std::string, std::size_t> place;
    for (std::size_t i = 0; i < names.size(); ++i) place.emplace(names[i], i);
    std::vector<double> times(names.size(), kNone);
    for (std::size_t row = 0; row < seconds_.size(); ++row) {
        const std::string& name = table_.rows[row][std::size_t(file_)];
        const auto found = place.find(name);
        if (found == place.end()) refuse(row, "there is no picture '" + name + "' in the folder");
        if (!std::isnan(times[found->second])) refuse(row, "'" + name + "' comes twice");
        times[found->second] = seconds_[row];
    }
    std::size_t missing = 0, first = 0;
    for (std::size_t i = names.size(); i-- > 0;) {
        if (std::isnan(times[i])) first = i, ++missing;
    }
    if (missing > 0) {
        throw Error(ErrorCode::bad_input,
                    "has no row for '" + names[first] + "'" +
                        (missing > 1 ? " and " + std::to_string(missing - 1) + " more" : ""),
                    path_.string());
    }
    return times;
}

int backward_steps(const std::vector<double>& times) {
    int count = 0;
    for (std::size_t i = 1; i < times.size(); ++i) count += times[i] < times[i - 1];
    return count;
}

bool has_variable_rate(const std::vector<double>& times, double tick) {
    if (times.size() < 3) return false;
    double least = times[1] - times[0], most = least;
    for (std::size_t i = 2; i < times.size(); ++i) {
        least = std::min(least, times[i] - times[i - 1]);
        most = std::max(most, times[i] - times[i - 1]);
    }
    // 1.001: of a difference of sums of ticks only rounding should remain.
    const double mean = (times.back() - times.front()) / double(times.size() - 1);
    return most - least > std::max(0.01 * mean, 1.001 * tick);
}

}  // namespace verdigris
