// SPDX-License-Identifier: MIT
// The color of copper looked up instead of computed: for pictures and movies.
#pragma once

#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/copper/surface.h"

namespace verdigris {

struct ColorTableOptions {
    double most_nm = 1000;  ///< thickest film, (0, 5000]; thicker ones read as this one
    double step_nm = 0.25;  ///< [0.05, 5]
    /// Values of the Cu2O share, 0 to 1 in equal steps, 2 to 129. chosen: 33 keep the error below
    /// 0.1 CIEDE2000; 5 are off by up to 4 (docs/models/copper.md).
    int fractions = 33;
    Observer observer{Observer::table};
};

/// Linear sRGB of surface_reflectance over (thickness, Cu2O share), bilinear between nodes. Same
/// options, same bytes at any thread count. Error against surface_reflectance with the defaults:
/// 0.001 in linear RGB and 0.1 CIEDE2000 at most (color_table_test.cpp).
class ColorTable {
  public:
    /// ~0.2 s on two cores and 1.6 MB with the defaults. Throws as check_optics(), and
    /// Error{usage} for options out of range.
    explicit ColorTable(const SurfaceOptics& optics = {}, const ColorTableOptions& options = {});

    /// Linear sRGB, unclipped, before exposure. States out of range are clamped, NaN reads as 0.
    /// The green layer is not tabulated: it mixes linearly, exactly. ~20 ns, 10 without patina.
    LinearF at(const SurfaceState& state) const;

    /// Nodes along thickness and along the Cu2O share.
    int thicknesses() const { return thicknesses_; }
    int fractions() const { return fractions_; }

  private:
    int thicknesses_ = 0, fractions_ = 0;
    double per_nm_ = 0;
    LinearF patina_;
    std::vector<LinearF> nodes_;  // [thickness][fraction]
};

}  // namespace verdigris
