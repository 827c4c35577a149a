// SPDX-License-Identifier: MIT
#include "verdigris/copper/spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verdigris/color/convert.h"

namespace verdigris {
namespace {

struct D65Row {
    double nm, power;
};
struct ObserverRow {
    double nm, x, y, z;
};
constexpr D65Row kD65[] = {
#include "illuminant_d65.inc"
};
constexpr ObserverRow kObserver[] = {
#include "observer_1931.inc"
};
static_assert(std::size(kD65) == kBands && std::size(kObserver) == kBands);

constexpr bool on_the_grid() {
    for (int i = 0; i < kBands; ++i) {
        if (kD65[i].nm != band_nm(i) || kObserver[i].nm != band_nm(i)) return false;
    }
    return true;
}
static_assert(on_the_grid());

// One lobe of the fits of [Wyman2013]: a bell with its own width on either side.
double lobe(double nm, double center, double left, double right) {
    const double t = (nm - center) / (nm < center ? left : right);
    return std::exp(-0.5 * t * t);
}

// Weights that make X, Y, Z out of a reflectance, scaled so that white has the XYZ that the room
// `color` calls white. The scale per row also takes out what 10 nm steps, or the fits, miss of D65.
std::array<Spectrum, 3> make_xyz_weights(Observer observer) {
    std::array<Spectrum, 3> weights{};
    std::array<double, 3> sum{};
    for (std::size_t band = 0; band < kBands; ++band) {
        const auto cmf = color_matching(int(band), observer);
        for (std::size_t c = 0; c < 3; ++c) {
            weights[c][band] = d65_power(int(band)) * cmf[c];
            sum[c] += weights[c][band];
        }
    }
    const Xyz white = xyz_from_linear({1, 1, 1});
    const std::array<double, 3> target{white.x, white.y, white.z};
    for (std::size_t c = 0; c < 3; ++c) {
        for (double& weight : weights[c]) weight *= target[c] / sum[c];
    }
    return weights;
}

const std::array<Spectrum, 3>& xyz_weights(Observer observer) {
    static const std::array<Spectrum, 3> table = make_xyz_weights(Observer::table);
    static const std::array<Spectrum, 3> fits = make_xyz_weights(Observer::fits);
    return observer == Observer::table ? table : fits;
}

// XYZ to linear RGB is linear: its columns are what it makes of (1,0,0), (0,1,0), (0,0,1).
std::array<Spectrum, 3> make_linear_weights(Observer observer) {
    const std::array<LinearF, 3> columns{linear_from_xyz({1, 0, 0}), linear_from_xyz({0, 1, 0}),
                                         linear_from_xyz({0, 0, 1})};
    const std::array<Spectrum, 3>& xyz = xyz_weights(observer);
    std::array<Spectrum, 3> weights{};
    for (std::size_t band = 0; band < kBands; ++band) {
        for (std::size_t c = 0; c < 3; ++c) {
            weights[0][band] += columns[c].r * xyz[c][band];
            weights[1][band] += columns[c].g * xyz[c][band];
            weights[2][band] += columns[c].b * xyz[c][band];
        }
    }
    return weights;
}

double dot(const Spectrum& a, const Spectrum& b) {
    double sum = 0;
    for (std::size_t i = 0; i < kBands; ++i) sum += a[i] * b[i];
    return sum;
}

}  // namespace

double d65_power(int band) {
    return kD65[band].power;
}

std::array<double, 3> color_matching(int band, Observer observer) {
    if (observer == Observer::table) {
        const ObserverRow& row = kObserver[band];
        return {row.x, row.y, row.z};
    }
    const double nm = band_nm(band);  // [Wyman2013], the multi-lobe fits
    return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                0.065 * lobe(nm, 501.1, 20.4, 26.2),
            0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
            1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

const std::array<Spectrum, 3>& linear_weights(Observer observer) {
    static const std::array<Spectrum, 3> table = make_linear_weights(Observer::table);
    static const std::array<Spectrum, 3> fits = make_linear_weights(Observer::fits);
    return observer == Observer::table ? table : fits;
}

Xyz xyz_from_reflectance(const Spectrum& reflectance, Observer observer) {
    const auto& w = xyz_weights(observer);
    return {float(dot(w[0], reflectance)), float(dot(w[1], reflectance)),
            float(dot(w[2], reflectance))};
}

LinearF linear_from_reflectance(const Spectrum& reflectance, Observer observer) {
    const auto& w = linear_weights(observer);
    return {float(dot(w[0], reflectance)), float(dot(w[1], reflectance)),
            float(dot(w[2], reflectance))};
}

SrgbF encoded_from_linear(LinearF linear, double exposure) {
    const auto shown = [exposure](float v) {
        return srgb_from_linear(std::clamp(float(v * exposure), 0.0f, 1.0f));
    };
    return {shown(linear.r), shown(linear.g), shown(linear.b)};
}

}  // namespace verdigris
