// SPDX-License-Identifier: MIT
// What the oxide is made of as it ages, and the green layer that grows on it where it is wet.
#pragma once

#include "verdigris/copper/growth.h"

namespace verdigris {

/// Share of Cu2O in the film against its thickness: copper oxidizes to Cu2O first, and CuO follows
/// in thick films. chosen, all four numbers. Beware: with these, films are nearly pure Cu2O where
/// the first-order blue would be (30 to 44 nm), and pure Cu2O has none (it goes from rose to
/// silver). For the full path of colors set `fresh` to 0.5 or less (docs/models/copper.md).
struct OxideChemistry {
    double fresh = 1, aged = 0.4;         ///< shares of Cu2O at both ends, [0, 1]
    double fresh_nm = 30, aged_nm = 150;  ///< between which thicknesses it goes over
};

/// fresh + (aged - fresh) smoothstep(nm; fresh_nm, aged_nm), within [0, 1]; monotone.
double cu2o_fraction(double film_nm, const OxideChemistry& chemistry = {});

struct PatinaOptions {
    /// Thickness in um per unit of wet exposure, [0, 1e3]. chosen: the 12 um at which the layer
    /// covers [Leygraf2019] take 120 wet units.
    double rate = 0.1;
    /// Oxide in nm below which no patina forms, [0, 1e5]. chosen: the brown has set in.
    double onset_nm = 150;
};

/// One step of a point: its oxide goes through `oxide_exposure` units from `film_nm` on, and
/// meanwhile it is wet for `wet_exposure` units (wetness map times time of wetness), both spread
/// evenly over the step.
struct PatinaStep {
    double patina_um = 0, film_nm = 0;
    double oxide_exposure = 0, wet_exposure = 0;
};

/// Thickness of the green layer in um after the step: dP/dt = rate * wetness while the oxide is
/// thicker than onset_nm; the crossing is found exactly, so half steps compose. Never shrinks.
/// Throws Error{usage} for options out of range.
double grow_patina(const PatinaStep& step, const GrowthLaw& law, const PatinaOptions& options = {});

}  // namespace verdigris
