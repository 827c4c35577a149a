// SPDX-License-Identifier: MIT
// Smooth random patterns on a plane, known at every point and not only at pixels: the same pattern
// comes out at any resolution.
#pragma once

#include <functional>
#include <vector>

#include "verdigris/pixels/image.h"
#include "verdigris/simulate/random.h"

namespace verdigris {

/// A stationary Gaussian random field of variance 1 with covariance exp(-x^2 / (2 lx^2) - y^2 / (2
/// ly^2)), as a sum of plane waves with random wave vectors [RahimiRecht2007].
class GaussianField {
  public:
    /// Correlation lengths in the units of the coordinates, > 0.
    GaussianField(const Random& random, double length_x, double length_y);
    /// O(waves): ~0.5 us. chosen: 96 waves; the kurtosis of a point's value is then within 0.02 of
    /// a Gaussian's.
    double at(double x, double y) const;

    static constexpr int kWaves = 96;

  private:
    struct Wave {
        double x, y, phase;
    };
    std::vector<Wave> waves_;
};

/// Square cells over a specimen of width x height, in sides (1 is its shorter side). The last
/// column and row may reach over its rim.
struct CellGrid {
    int columns = 0, rows = 0;
    double cell = 0;  ///< side of a cell
    double width = 0, height = 0;
    double x(int column) const { return (column + 0.5) * cell; }
    double y(int row) const { return (row + 0.5) * cell; }
};
/// `cells` across the longer side of a specimen of this aspect.
CellGrid cell_grid(double width, double height, int cells);

/// The field at every cell, shifted and scaled to mean 0 and standard deviation 1 over them (all
/// zero if it is constant). In parallel.
Image<double> sampled(const GaussianField& field, const CellGrid& grid);
/// Shifts and scales to mean 0 and standard deviation 1 in place.
void standardize(Image<double>& field);

/// Between the cells, bilinearly; beyond them the nearest. `column` and `row` count cell centers.
double read_between(const Image<double>& cells, double column, double row);

/// Called now and then in long work; may throw to end it. Empty: run to the end.
using Breathe = std::function<void()>;

/// The pattern that reaction and diffusion leave [GrayScott1984] on a torus of side x side cells
/// after `steps` explicit steps of 1 with D_u = 0.16 and D_v = 0.08: the concentration v. Stable,
/// since 4 D <= 1; values stay in [0, 1]. O(side^2 steps); 128, 6000: ~0.1 s.
Image<double> gray_scott(const Random& random, int side, double feed, double kill, int steps,
                         const Breathe& breathe = {});

}  // namespace verdigris
