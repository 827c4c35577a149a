// SPDX-License-Identifier: MIT
#include "verdigris/copper/thin_film.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "verdigris/error.h"

namespace verdigris {
namespace {

using Complex = std::complex<double>;
constexpr Complex kI{0, 1};

void check(double wavelength_nm, std::span<const FilmLayer> layers, Complex substrate,
           const Incidence& incidence) {
    const auto refuse = [](const std::string& sentence) {
        throw Error(ErrorCode::usage, sentence);
    };
    if (!(wavelength_nm > 0)) {
        refuse(fmt::format("a wavelength of {} nm; it must be above 0", wavelength_nm));
    }
    if (!(incidence.angle >= 0 && incidence.angle < std::numbers::pi / 2)) {
        refuse(fmt::format("an angle of incidence of {} rad; allowed are 0 to below pi/2",
                           incidence.angle));
    }
    const auto check_index = [&](Complex index) {
        if (!(index.real() > 0 && index.imag() >= 0)) {
            refuse(fmt::format("an index of {} + {} i; n must be above 0 and k at least 0",
                               index.real(), index.imag()));
        }
    };
    for (const FilmLayer& layer : layers) {
        check_index(layer.index);
        if (!(layer.thickness_nm >= 0 && layer.thickness_nm <= 1e12)) {
            refuse(fmt::format("a film thickness of {} nm; allowed are 0 to 1e12",
                               layer.thickness_nm));
        }
    }
    check_index(substrate);
}

// The mean over the polarizations that are asked for. At normal incidence s and p are one.
template <class Reflectance>
double over_polarizations(const Incidence& incidence, Reflectance reflectance) {
    if (incidence.polarization != Polarization::unpolarized) {
        return reflectance(incidence.polarization);
    }
    if (incidence.angle == 0) return reflectance(Polarization::s);
    return (reflectance(Polarization::s) + reflectance(Polarization::p)) / 2;
}

double airy(double wavelength_nm, std::span<const FilmLayer> layers, Complex substrate,
            double angle, Polarization polarization) {
    const auto step = [](Complex above, Complex below) {
        return (above - below) / (above + below);
    };
    Complex below =
        tilted_admittance(substrate, normal_wave_number(substrate, angle), polarization);
    Complex r = 0;
    for (std::size_t i = layers.size(); i-- > 0;) {
        const Complex q = normal_wave_number(layers[i].index, angle);
        const Complex here = tilted_admittance(layers[i].index, q, polarization);
        const Complex single = step(here, below);
        r = (single + r) / (1.0 + single * r);
        // There and back through this film; what comes next sees r from its upper side.
        r *= std::exp(4 * std::numbers::pi * kI * q * layers[i].thickness_nm / wavelength_nm);
        below = here;
    }
    const Complex air = tilted_admittance(1, normal_wave_number(1, angle), polarization);
    const Complex top = step(air, below);
    return std::norm((top + r) / (1.0 + top * r));
}

double transfer(double wavelength_nm, std::span<const FilmLayer> layers, Complex substrate,
                double angle, Polarization polarization) {
    // Tangential electric and magnetic field at the substrate, carried upwards film by film.
    Complex electric = 1;
    Complex magnetic =
        tilted_admittance(substrate, normal_wave_number(substrate, angle), polarization);
    for (std::size_t i = layers.size(); i-- > 0;) {
        const Complex q = normal_wave_number(layers[i].index, angle);
        const Complex admittance = tilted_admittance(layers[i].index, q, polarization);
        const Complex phase = 2 * std::numbers::pi * q * layers[i].thickness_nm / wavelength_nm;
        // cos and -i sin of the phase, both times e^{i phase}: never more than 1 in size, and the
        // common factor leaves the ratio of the fields as it is.
        const Complex decay = std::exp(2.0 * kI * phase);
        const Complex cosine = (1.0 + decay) / 2.0, minus_i_sine = (1.0 - decay) / 2.0;
        const Complex above = cosine * electric + minus_i_sine / admittance * magnetic;
        magnetic = minus_i_sine * admittance * electric + cosine * magnetic;
        electric = above;
    }
    const Complex air = tilted_admittance(1, normal_wave_number(1, angle), polarization);
    return std::norm((air * electric - magnetic) / (air * electric + magnetic));
}

}  // namespace

std::complex<double> normal_wave_number(std::complex<double> index, double angle) {
    if (angle == 0) return index;
    const double sine = std::sin(angle);
    const Complex q = std::sqrt(index * index - sine * sine);
    return q.imag() < 0 ? -q : q;  // only a k of -0.0 makes the principal root a growing wave
}

std::complex<double> tilted_admittance(std::complex<double> index, std::complex<double> q,
                                       Polarization polarization) {
    return polarization == Polarization::p ? index * index / q : q;
}

double airy_reflectance(double wavelength_nm, std::span<const FilmLayer> layers,
                        std::complex<double> substrate, const Incidence& incidence) {
    check(wavelength_nm, layers, substrate, incidence);
    return over_polarizations(incidence, [&](Polarization polarization) {
        return airy(wavelength_nm, layers, substrate, incidence.angle, polarization);
    });
}

double transfer_matrix_reflectance(double wavelength_nm, std::span<const FilmLayer> layers,
                                   std::complex<double> substrate, const Incidence& incidence) {
    check(wavelength_nm, layers, substrate, incidence);
    return over_polarizations(incidence, [&](Polarization polarization) {
        return transfer(wavelength_nm, layers, substrate, incidence.angle, polarization);
    });
}

}  // namespace verdigris
