// SPDX-License-Identifier: MIT
#include "verdigris/copper/growth.h"

#include <algorithm>
#include <cmath>

#include "verdigris/copper/in_range.h"

namespace verdigris {
GrowthLaw::GrowthLaw(const GrowthOptions& options) : options_(options) {
    demand_in_range(options.parabolic_rate, 1e-9, 1e6, "parabolic_rate");
    demand_in_range(options.logarithmic_nm, 0.1, 10, "logarithmic_nm");
    demand_in_range(options.inverse_nm, 0.1, 50, "inverse_nm");
    // The rates of neighboring laws are equal at the border: k_p / (2 L) = k_3 / (3 L^2) at 25 nm.
    cubic_rate_ = 1.5 * kParabolicFromNm * options.parabolic_rate;
    rate_at_border_ = cubic_rate_ / (3 * kCubicFromNm * kCubicFromNm);
    inverse_rate_ = rate_at_border_ * std::exp(-options.inverse_nm / kCubicFromNm);
    inverse_border_ = inverse_clock(kCubicFromNm);
}

double GrowthLaw::rate(double nm) const {
    if (nm >= kParabolicFromNm) return options_.parabolic_rate / (2 * nm);
    if (nm >= kCubicFromNm) return cubic_rate_ / (3 * nm * nm);
    if (options_.thin_film == ThinFilmLaw::direct_logarithmic) {
        return rate_at_border_ * std::exp((kCubicFromNm - nm) / options_.logarithmic_nm);
    }
    return inverse_rate_ * std::exp(options_.inverse_nm / nm);
}

double GrowthLaw::inverse_clock(double nm) const {
    // u t = integral from 0 to L of exp(-a/l) dl = L exp(-a/L) - a E1(a/L), with Ei(-x) = -E1(x)
    // [AbramowitzStegun1964] 5.1.
    if (!(nm > 0)) return 0;
    const double x = options_.inverse_nm / nm;
    return std::max(0.0, (nm * std::exp(-x) + options_.inverse_nm * std::expint(-x))) /
           inverse_rate_;
}

double GrowthLaw::grow_thin(double nm, double exposure) const {
    if (options_.thin_film == ThinFilmLaw::direct_logarithmic) {
        return nm +
               options_.logarithmic_nm * std::log1p(rate(nm) * exposure / options_.logarithmic_nm);
    }
    // No closed inverse: Newton's method, kept inside a bracket that shrinks. The logarithm of the
    // clock is nearly a straight line in 1/L, so it is solved for there: four rounds as a rule.
    const double target = inverse_clock(nm) + exposure;
    if (target >= inverse_border_) return kCubicFromNm;
    // The rate only falls, so keeping its first value overshoots: a close bound for short steps.
    double low = nm, high = std::min(kCubicFromNm, nm + rate(nm) * exposure), guess = high;
    for (int i = 0; i < 200; ++i) {
        const double clock = inverse_clock(guess);
        (clock > target ? high : low) = guess;
        const double slope = rate(guess) * clock / (guess * guess);
        double next = 1 / (1 / guess + std::log(clock / target) * slope);
        // Before the bracket is asked: at the root rounding may carry `next` across its end.
        if (std::abs(next - guess) <= 1e-14 * guess) return next;
        if (!(next > low && next < high)) next = (low + high) / 2;
        guess = next;
    }
    return guess;
}

double GrowthLaw::grow(double nm, double exposure) const {
    if (!(exposure > 0) || !(nm >= 0)) return nm;
    if (nm < kCubicFromNm) {
        const double end = grow_thin(nm, exposure);
        if (end < kCubicFromNm) return std::max(nm, end);
        exposure = std::max(0.0, exposure - exposure_between(nm, kCubicFromNm));
        nm = kCubicFromNm;
    }
    if (nm < kParabolicFromNm) {
        const double needed = exposure_between(nm, kParabolicFromNm);
        if (exposure < needed) {
            // L1 - L0 = k t / (L1^2 + L1 L0 + L0^2): a difference of cubes would lose tiny steps.
            const double step = cubic_rate_ * exposure, end = std::cbrt(nm * nm * nm + step);
            return std::min(nm + step / (end * end + end * nm + nm * nm), kParabolicFromNm);
        }
        nm = kParabolicFromNm;
        exposure -= needed;
    }
    const double step = options_.parabolic_rate * exposure;
    return nm + step / (nm + std::sqrt(nm * nm + step));
}

double GrowthLaw::exposure_between(double from, double to) const {
    if (!(to > from)) return 0;
    double exposure = 0;
    if (from < kCubicFromNm) {
        const double end = std::min(to, kCubicFromNm);
        if (options_.thin_film == ThinFilmLaw::direct_logarithmic) {
            exposure += options_.logarithmic_nm / rate(from) *
                        std::expm1((end - from) / options_.logarithmic_nm);
        } else {
            exposure +=
                (end == kCubicFromNm ? inverse_border_ : inverse_clock(end)) - inverse_clock(from);
        }
        from = end;
    }
    if (from < to && from < kParabolicFromNm) {
        const double end = std::min(to, kParabolicFromNm);
        exposure += (end * end * end - from * from * from) / cubic_rate_;
        from = end;
    }
    if (from < to) exposure += (to * to - from * from) / options_.parabolic_rate;
    return exposure;
}

}  // namespace verdigris
