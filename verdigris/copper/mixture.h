// SPDX-License-Identifier: MIT
// The index of a film in which two materials are mixed finer than light can see.
#pragma once

#include <complex>

namespace verdigris {

/// Permittivity of a mixture of two, `fraction` in [0, 1] the volume share of the first, by the
/// symmetric effective-medium theory of [Bruggeman1935]; the end points are exact. Solves
/// f (e1 - e)/(e1 + 2e) + (1-f)(e2 - e)/(e2 + 2e) = 0 for the root that absorbs (Im >= 0).
/// Throws Error{usage} for a fraction out of range.
std::complex<double> bruggeman_permittivity(std::complex<double> first, std::complex<double> second,
                                            double fraction);

/// The same for refractive indices n + i k: permittivity is the index squared.
std::complex<double> bruggeman_index(std::complex<double> first, std::complex<double> second,
                                     double fraction);

}  // namespace verdigris
