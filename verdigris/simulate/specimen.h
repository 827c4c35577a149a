// SPDX-License-Identifier: MIT
// A piece of copper that corrodes, on a grid of cells: where the film starts, how thick it is, what
// color that makes. Model: docs/models/simulate.md
#pragma once

#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/copper/color_table.h"
#include "verdigris/copper/environment.h"
#include "verdigris/copper/growth.h"
#include "verdigris/pixels/image.h"
#include "verdigris/simulate/field.h"
#include "verdigris/simulate/spec.h"

namespace verdigris {

/// Susceptibility rho(x) > 0, mean 1 over the cells: static, as in the paper.
Image<double> susceptibility_field(const SimulationSpec& spec, const CellGrid& grid,
                                   const Breathe& breathe = {});
/// Wetness > 0, mean 1: where water stands and runs.
Image<double> wetness_field(const SimulationSpec& spec, const CellGrid& grid);

/// The grid of the spec's specimen.
CellGrid specimen_grid(const SimulationSpec& spec);

/// A nucleus of the film.
struct Nucleus {
    double unit, x, y;  ///< when, and where in sides
};
/// A Poisson process over time and area whose rate follows rho, up to 4, in the order of time.
std::vector<Nucleus> draw_nuclei(const SimulationSpec& spec, const CellGrid& grid,
                                 const Image<double>& susceptibility);

/// theta after `step` units: D lap(theta) + a rho theta (1 - theta), explicit Euler in as many
/// parts as keep h D / cell^2 <= 1/5 and h a rho <= 1/5, no flux over the rim. Result within [0,
/// 1]. `scratch` is of the same size.
void spread_coverage(Image<double>& theta, Image<double>& scratch,
                     const Image<double>& susceptibility, const CellGrid& grid, double diffusion,
                     double growth, double step, const Breathe& breathe = {});

class Specimen {
  public:
    /// Throws as check_spec(), and Error{bad_input} naming an optical table that cannot be used.
    explicit Specimen(const SimulationSpec& spec, const Breathe& breathe = {});

    /// To a later time, in steps of kStepUnits at most. Deterministic at any thread count; the
    /// result depends on the steps only through the coverage. ~60 ns a cell and step, one core.
    void advance_to(double unit, const Breathe& breathe = {});
    double unit() const { return unit_; }

    /// Linear sRGB of every cell before any exposure. ~20 ns a cell.
    Image<LinearF> color() const;

    const CellGrid& grid() const { return grid_; }
    const Image<double>& susceptibility() const { return susceptibility_; }
    const Image<double>& wetness() const { return wetness_; }
    const Image<double>& coverage() const {
        return coverage_;
    }  ///< theta in [0, 1], the share that grows
    const Image<double>& film_nm() const { return film_nm_; }  ///< never falls
    const Image<double>& patina_um() const { return patina_um_; }
    const Environment& environment() const { return environment_; }

    static constexpr double kStepUnits = 0.1;

  private:
    void step(double to, const Breathe& breathe);
    void plant(double until);

    SimulationSpec spec_;
    CellGrid grid_;
    Environment environment_;
    GrowthLaw law_;
    Image<double> susceptibility_, wetness_, coverage_, scratch_, film_nm_, patina_um_;
    ColorTable table_;
    std::vector<Nucleus> nuclei_;
    std::size_t planted_ = 0;
    double unit_ = 0;
};

}  // namespace verdigris
