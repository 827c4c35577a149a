// SPDX-License-Identifier: MIT
// From a reflectance at each wavelength to a color, under D65 for the CIE 1931 2 degree observer.
#pragma once

#include <array>

#include "verdigris/color/pixel_types.h"

namespace verdigris {

/// The wavelengths at which everything optical is computed: 380 to 780 nm, every 10 nm.
inline constexpr int kBands = 41;
inline constexpr double kFirstBandNm = 380, kBandStepNm = 10;
constexpr double band_nm(int band) {
    return kFirstBandNm + kBandStepNm * band;
}

/// Reflectance factor per band, in [0, 1].
using Spectrum = std::array<double, kBands>;

/// Whose eyes: the published table [CIE15], or the analytic fits to it of [Wyman2013], which need
/// no table on a GPU. The two differ by less than 1 CIEDE2000 on copper (docs/models/copper.md).
enum class Observer { table, fits };

/// Spectral power of the illuminant D65 in one band, 100 at 560 nm [CIE15].
double d65_power(int band);
/// Color-matching functions (x, y, z) of one band.
std::array<double, 3> color_matching(int band, Observer observer);

/// Weight of each band in linear R, G, B. A color is a dot product with these:
/// linear[c] = sum over bands of weights[c][band] * reflectance[band].
/// A perfect white is exactly the white of linear sRGB, (1, 1, 1) to rounding. Negative weights are
/// right: saturated colors lie outside sRGB.
const std::array<Spectrum, 3>& linear_weights(Observer observer = Observer::table);

/// XYZ under D65 with white as in the room `color`. O(bands).
Xyz xyz_from_reflectance(const Spectrum& reflectance, Observer observer = Observer::table);
/// Linear sRGB, unclipped: bare copper's red is above 1. O(bands).
LinearF linear_from_reflectance(const Spectrum& reflectance, Observer observer = Observer::table);

/// What a camera with this exposure would show: linear times exposure, clipped to [0, 1], encoded.
/// chosen: 0.6 by default, so that bare copper (red 1.04) is not clipped.
inline constexpr double kDefaultExposure = 0.6;
SrgbF encoded_from_linear(LinearF linear, double exposure = kDefaultExposure);

}  // namespace verdigris
