// SPDX-License-Identifier: MIT
// A copper surface under oxide and patina: its reflectance at every wavelength.
#pragma once

#include "verdigris/copper/optical_constants.h"
#include "verdigris/copper/spectrum.h"
#include "verdigris/copper/thin_film.h"

namespace verdigris {

/// What a point of the surface is made of.
struct SurfaceState {
    double film_nm = 0;        ///< mean thickness of the oxide by mass, >= 0
    double cu2o_fraction = 1;  ///< share of Cu2O in its volume, [0, 1]; the rest is CuO
    double patina_um = 0;      ///< thickness of the green layer, >= 0
};

enum class FilmStructure {
    mixed,    ///< both oxides mixed finer than light can see [Bruggeman1935]
    layered,  ///< Cu2O on the metal, CuO on top of it
};

struct FilmMaterials {
    OpticalConstants metal = copper_constants();
    OpticalConstants cuprous = cuprous_oxide_constants();
    OpticalConstants cupric = cupric_oxide_constants();
};

/// How a surface meets light.
struct SurfaceOptics {
    FilmMaterials materials = {};  ///< each must cover 380 to 780 nm
    FilmStructure structure{FilmStructure::mixed};
    Incidence incidence = {};
    /// Relative standard deviation of the film's thickness within a pixel, [0, 0.3]. It washes out
    /// the second and higher orders. chosen: real films lie within 0.05 to 0.2.
    double thickness_spread = 0.1;
    /// True area over projected area, [1, 5]: on rough metal the same mass of oxide is spread
    /// thinner, so optics sees film_nm / roughness_factor. Historical thicknesses, weighed on
    /// abraded metal, are 1.25 to 1.8 times ours.
    double roughness_factor = 1;
    /// Films beyond a few hundred nm turn into a rough brown crust that no film optics describes.
    bool brown_limit = true;
};

/// Throws Error{usage} naming the field and the allowed range, Error{bad_input} if a table does not
/// cover the visible range. Called by everything that takes SurfaceOptics.
void check_optics(const SurfaceOptics& optics);

/// Spectral reflectance of one state: the mean of the film's reflectance over its thickness, the
/// brown limit, the green layer. In [0, 1] per band. Throws as check_optics(), and Error{usage} on
/// a state out of range. ~20 us: for a picture, use ColorTable. Source: docs/models/copper.md.
Spectrum surface_reflectance(const SurfaceState& state, const SurfaceOptics& optics = {});

/// Share of the brown crust for a film of this thickness, [0, 1): 1 - exp(-(L / 300 nm)^2).
/// chosen so that it is complete at the 0.8 um of Cu2O at which [Leygraf2019] finds brown-black
/// attained.
double brown_share(double film_nm);
/// Reflectance of the brown crust, per band (chosen; Lab about 25, 10, 8).
const Spectrum& brown_spectrum();
/// What the green layer lets through, twice: exp(-2 P / 4 um), in (0, 1]. chosen so that 12 um
/// hide what is below, as [Leygraf2019] finds; layers as in [DorseyHanrahan1996].
double patina_transmission(double patina_um);
/// Reflectance of the green layer where it hides everything, per band (chosen; Lab about 66,-24,1).
const Spectrum& patina_spectrum();

/// One node of the spread of thickness: the film is `factor` times its mean with this weight.
struct ThicknessNode {
    double factor, weight;
};
/// Five-point Gauss-Hermite rule [AbramowitzStegun1964] for a spread s: factors 1 + s sqrt(2) x,
/// weights summing to 1. Exact for polynomials in thickness up to degree 9.
std::array<ThicknessNode, 5> thickness_nodes(double spread);

/// Films of one state at one wavelength, top first; `thickness_nm` in parts of the film's total.
struct UnitFilm {
    std::array<FilmLayer, 2> layers;
    int count = 0;
};
UnitFilm unit_film(const SurfaceOptics& optics, double cu2o_fraction, double wavelength_nm);

}  // namespace verdigris
