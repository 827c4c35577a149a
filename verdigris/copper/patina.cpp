// SPDX-License-Identifier: MIT
#include "verdigris/copper/patina.h"

#include <algorithm>
#include <cmath>

#include "verdigris/copper/in_range.h"

namespace verdigris {
double cu2o_fraction(double film_nm, const OxideChemistry& chemistry) {
    const double width = chemistry.aged_nm - chemistry.fresh_nm;
    const double t = width > 0 ? std::clamp((film_nm - chemistry.fresh_nm) / width, 0.0, 1.0)
                               : double(film_nm >= chemistry.aged_nm);
    const double smooth = t * t * (3 - 2 * t);
    return std::clamp(std::lerp(chemistry.fresh, chemistry.aged, smooth), 0.0, 1.0);
}

double grow_patina(const PatinaStep& step, const GrowthLaw& law, const PatinaOptions& options) {
    demand_in_range(options.rate, 0, 1e3, "rate");
    demand_in_range(options.onset_nm, 0, 1e5, "onset_nm");
    if (!(step.wet_exposure > 0)) return step.patina_um;
    double share = 1;  // of the step that the oxide spends above the onset
    if (step.film_nm <= options.onset_nm) {
        const double needed = law.exposure_between(step.film_nm, options.onset_nm);
        if (!(step.oxide_exposure > needed)) return step.patina_um;
        share = (step.oxide_exposure - needed) / step.oxide_exposure;
    }
    return step.patina_um + options.rate * step.wet_exposure * share;
}

}  // namespace verdigris
