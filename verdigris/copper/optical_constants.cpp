// SPDX-License-Identifier: MIT
#include "verdigris/copper/optical_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/csv.h"

namespace verdigris {
namespace {

using Row = OpticalConstants::Row;

// chosen: hard ultraviolet to far infrared, and beyond the largest index measured there. What is
// outside is a slip of unit or column, not a material.
constexpr double kMinNm = 10, kMaxNm = 1e6, kMaxIndex = 200;

/// What is wrong with a row, as the end of a sentence; nothing if it is fine.
std::optional<std::string> fault(const Row& row, const Row* before) {
    if (!(row.wavelength_nm >= kMinNm && row.wavelength_nm <= kMaxNm)) {
        return fmt::format("gives a wavelength of {} nm; allowed are {} to {} nm",
                           row.wavelength_nm, kMinNm, kMaxNm);
    }
    if (before && !(row.wavelength_nm > before->wavelength_nm)) {
        return fmt::format("gives {} nm after {} nm; wavelengths must rise", row.wavelength_nm,
                           before->wavelength_nm);
    }
    if (!(row.n > 0 && row.n <= kMaxIndex)) {
        return fmt::format("gives n = {}; allowed are values above 0 up to {}", row.n, kMaxIndex);
    }
    if (!(row.k >= 0 && row.k <= kMaxIndex)) {
        return fmt::format("gives k = {}; allowed are 0 to {}", row.k, kMaxIndex);
    }
    return std::nullopt;
}

double number(const std::string& cell, const std::string& column, const std::string& where) {
    const auto trim_from = cell.find_first_not_of(" \t");
    const auto trim_to = cell.find_last_not_of(" \t");
    const std::string_view text =
        trim_from == std::string::npos
            ? std::string_view()
            : std::string_view(cell).substr(trim_from, trim_to - trim_from + 1);
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || problem != std::errc() || end != text.data() + text.size()) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("column {} holds \"{}\", which is no number", column, cell), where);
    }
    return value;
}

// Made from data/*.csv when the build is configured, so that the numbers are typed once.
constexpr Row kCopper[] = {
#include "copper.inc"
};
constexpr Row kCuprousOxide[] = {
#include "cuprous_oxide.inc"
};
constexpr Row kCupricOxide[] = {
#include "cupric_oxide.inc"
};

template <std::size_t N>
OpticalConstants built_in(const char* name, const Row (&rows)[N]) {
    return {name, std::vector<Row>(rows, rows + N)};
}

}  // namespace

OpticalConstants::OpticalConstants(std::string name, std::vector<Row> rows)
    : name_(std::move(name)), rows_(std::move(rows)) {
    if (rows_.size() < 2) {
        throw Error(
            ErrorCode::bad_input,
            fmt::format("holds {} rows of optical constants; two are the least", rows_.size()),
            name_);
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        if (const auto wrong = fault(rows_[i], i > 0 ? &rows_[i - 1] : nullptr)) {
            throw Error(ErrorCode::bad_input, fmt::format("row {} {}", i + 1, *wrong), name_);
        }
    }
}

std::complex<double> OpticalConstants::at(double nm) const {
    if (!(nm >= rows_.front().wavelength_nm && nm <= rows_.back().wavelength_nm)) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("has no value at {} nm; it covers {} to {} nm", nm,
                                rows_.front().wavelength_nm, rows_.back().wavelength_nm),
                    name_);
    }
    const auto above =
        std::upper_bound(rows_.begin() + 1, rows_.end() - 1, nm,
                         [](double wanted, const Row& row) { return wanted < row.wavelength_nm; });
    const Row &hi = *above, &lo = *(above - 1);
    const double t = (nm - lo.wavelength_nm) / (hi.wavelength_nm - lo.wavelength_nm);
    return {std::lerp(lo.n, hi.n, t), std::lerp(lo.k, hi.k, t)};
}

const OpticalConstants& copper_constants() {
    static const OpticalConstants table = built_in("copper", kCopper);
    return table;
}
const OpticalConstants& cuprous_oxide_constants() {
    static const OpticalConstants table = built_in("cuprous oxide", kCuprousOxide);
    return table;
}
const OpticalConstants& cupric_oxide_constants() {
    static const OpticalConstants table = built_in("cupric oxide", kCupricOxide);
    return table;
}

OpticalConstants read_optical_constants(const std::filesystem::path& path) {
    const CsvTable csv = read_csv(path);
    const int nm = csv.column("wavelength_nm"), um = csv.column("wavelength_um");
    const int n = csv.column("n"), k = csv.column("k");
    if ((nm < 0 && um < 0) || n < 0 || k < 0) {
        throw Error(ErrorCode::bad_input,
                    "needs the columns wavelength_nm (or wavelength_um), n and k", path.string());
    }
    std::vector<Row> rows;
    for (std::size_t i = 0; i < csv.rows.size(); ++i) {
        const std::string where = fmt::format("{}, line {}", path.string(), csv.lines[i]);
        const auto cell = [&](int column) {
            return number(csv.rows[i][std::size_t(column)], csv.header[std::size_t(column)], where);
        };
        const Row row{nm >= 0 ? cell(nm) : 1000 * cell(um), cell(n), cell(k)};
        if (const auto wrong = fault(row, rows.empty() ? nullptr : &rows.back())) {
            throw Error(ErrorCode::bad_input, *wrong, where);
        }
        rows.push_back(row);
    }
    return {path.string(), std::move(rows)};
}

}  // namespace verdigris
