// SPDX-License-Identifier: MIT
// How much light a stack of films on a metal reflects, computed in two ways that know nothing of
// each other. Plane waves e^{-i w t}, smooth interfaces, air above. Derivation:
// docs/models/copper.md
#pragma once

#include <complex>
#include <span>

namespace verdigris {

/// One homogeneous film: index n + i k (k >= 0) and thickness in nm, 0 to 1e12.
struct FilmLayer {
    std::complex<double> index{1, 0};
    double thickness_nm = 0;
};

enum class Polarization { s, p, unpolarized };  ///< unpolarized: the mean of s and p

/// Where the light comes from: angle to the normal in radians, [0, pi/2).
struct Incidence {
    double angle = 0;
    Polarization polarization{Polarization::unpolarized};
};

/// Normal component of the wave vector in a medium, in units of 2 pi / wavelength:
/// sqrt(N^2 - sin^2 angle), the root that decays away from the air. At normal incidence N itself.
std::complex<double> normal_wave_number(std::complex<double> index, double angle);
/// Tilted admittance: q for s and N^2 / q for p, with q the normal wave number.
std::complex<double> tilted_admittance(std::complex<double> index, std::complex<double> q,
                                       Polarization polarization);

/// Reflectance, in [0, 1] to rounding, of `layers` (top first) on a substrate of infinite depth, by
/// the recursion of Airy's sum from the substrate upwards [BornWolf1999]. Stable for any thickness;
/// an opaque film hides what is below. Throws Error{usage} on an angle, a thickness, an index out
/// of range. O(layers), ~0.1 us each.
double airy_reflectance(double wavelength_nm, std::span<const FilmLayer> layers,
                        std::complex<double> substrate, const Incidence& incidence = {});

/// The same by the product of characteristic 2x2 matrices [BornWolf1999], each scaled by its own
/// decay so that an opaque film does not overflow. Agrees with airy_reflectance to 1e-12.
double transfer_matrix_reflectance(double wavelength_nm, std::span<const FilmLayer> layers,
                                   std::complex<double> substrate, const Incidence& incidence = {});

}  // namespace verdigris
