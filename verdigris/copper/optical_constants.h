// SPDX-License-Identifier: MIT
// How a material slows and absorbs light: n + i k against wavelength.
#pragma once

#include <complex>
#include <filesystem>
#include <string>
#include <vector>

namespace verdigris {

/// A table n + i k (time convention e^{-i w t}: k > 0 absorbs), read by linear interpolation.
class OpticalConstants {
  public:
    struct Row {
        double wavelength_nm, n, k;
    };

    /// `name` stands in error messages. Rows: wavelength strictly rising within
    /// [10, 1e6] nm, n in (0, 200], k in [0, 200], at least two.
    /// Throws Error{bad_input} naming the table and the row.
    OpticalConstants(std::string name, std::vector<Row> rows);

    /// Index at a wavelength in nm, interpolated linearly in n and k. Never extrapolates: throws
    /// Error{bad_input} naming the table, the wavelength and the range it covers. O(log rows).
    std::complex<double> at(double wavelength_nm) const;

    const std::string& name() const { return name_; }
    const std::vector<Row>& rows() const { return rows_; }

  private:
    std::string name_;
    std::vector<Row> rows_;
};

/// Copper, evaporated, 380 to 780 nm every 10 nm [McPeak2015]. Other measurements of copper give
/// other colors (docs/models/copper.md says by how much): that is the uncertainty of the model.
const OpticalConstants& copper_constants();
/// Cu2O, cuprite, the red oxide next to the metal, 380 to 780 nm [Palik1991].
const OpticalConstants& cuprous_oxide_constants();
/// CuO, tenorite, the black oxide, 380 to 780 nm [Palik1991].
const OpticalConstants& cupric_oxide_constants();

/// Reads a table of one's own: CSV with the columns `wavelength_nm` (or `wavelength_um`), `n`, `k`,
/// `#` comments allowed. Throws Error{bad_input} naming the file, the line and the allowed range.
OpticalConstants read_optical_constants(const std::filesystem::path& path);

}  // namespace verdigris
