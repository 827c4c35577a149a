// SPDX-License-Identifier: MIT
// How fast an oxide film thickens, and how thick it is after a while: exactly, regime by regime.
#pragma once

namespace verdigris {

/// The law below 5 nm, where the field across the film drives the ions.
enum class ThinFilmLaw {
    direct_logarithmic,  ///< r = r(5 nm) exp(-(L - 5 nm) / length): starts at a finite rate
    inverse_logarithmic  ///< r = u exp(length / L) [CabreraMott1949]: starts infinitely fast
};

struct GrowthOptions {
    /// k_p in nm^2 per unit of exposure, (0, 1e6]. derived: 0.3 takes a film from 4 to 10.6 nm in
    /// the 98.4 units of a recording, which changes the mean color by the 0.12 to 0.13 that [Paper]
    /// prints (color_path_test.cpp).
    double parabolic_rate = 0.3;
    ThinFilmLaw thin_film{ThinFilmLaw::direct_logarithmic};
    /// Length of the direct logarithmic law in nm, [0.1, 10]. chosen.
    double logarithmic_nm = 1.5;
    /// Length of the inverse logarithmic law in nm, [0.1, 50]. derived: q a V / (k T), half a jump
    /// of 0.26 nm at 1 V and 300 K; u is set so that the rate joins the cubic law at 5 nm.
    double inverse_nm = 10;
};

/// Growth of copper oxide: logarithmic below 5 nm, cubic to 25 nm, parabolic above, as measured by
/// ellipsometry between 313 and 453 K [Fujita2014]; the rates join at both borders. Time enters as
/// exposure: the integral over time of everything that scales the rate (coverage, susceptibility,
/// pace of the environment), in units. Nothing here is stepped, so steps of any length compose:
/// grow(grow(L, a), b) is grow(L, a + b) to rounding.
class GrowthLaw {
  public:
    static constexpr double kCubicFromNm = 5, kParabolicFromNm = 25;

    /// Throws Error{usage} naming the option and the allowed range.
    explicit GrowthLaw(const GrowthOptions& options = {});

    /// dL/d(exposure) in nm per unit at thickness `nm` >= 0; never rises with it. Infinite at 0 for
    /// the inverse logarithmic law.
    double rate(double nm) const;

    /// Thickness in nm of a film of `nm` >= 0 after `exposure` >= 0 units. Never less than `nm`.
    /// NaN, or an exposure below 0, leaves the film as it is. ~30 ns (inverse logarithmic below
    /// 5 nm: ~1.5 us).
    double grow(double nm, double exposure) const;

    /// Units of exposure that take a film from `from` to `to` nm, 0 <= from <= to: the inverse of
    /// grow. 0 if to <= from.
    double exposure_between(double from, double to) const;

    const GrowthOptions& options() const { return options_; }

  private:
    double inverse_clock(double nm) const;  // exposure from 0 to nm <= 5 by Cabrera and Mott
    /// grow by the law below 5 nm; 5 or more if the film gets beyond it meanwhile.
    double grow_thin(double nm, double exposure) const;

    GrowthOptions options_;
    double cubic_rate_ = 0;      // k_3 in nm^3 per unit: L^3 grows by k_3 per unit
    double rate_at_border_ = 0;  // at 5 nm
    double inverse_rate_ = 0;    // u in nm per unit
    double inverse_border_ = 0;  // inverse_clock at 5 nm
};

}  // namespace verdigris
