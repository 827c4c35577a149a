// SPDX-License-Identifier: MIT
#include "verdigris/copper/surface.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "verdigris/copper/in_range.h"
#include "verdigris/copper/mixture.h"

namespace verdigris {
namespace {

constexpr double kBrownNm = 300;      // see brown_share
constexpr double kPatinaDepthUm = 4;  // see patina_transmission

void check(const SurfaceState& state) {
    // chosen: beyond 0.1 mm it is not a film, whatever it is.
    demand_in_range(state.film_nm, 0, 1e5, "film_nm");
    demand_in_range(state.cu2o_fraction, 0, 1, "cu2o_fraction");
    demand_in_range(state.patina_um, 0, 1e4, "patina_um");
}

template <class F>
Spectrum per_band(F of_nm) {
    Spectrum spectrum{};
    for (int i = 0; i < kBands; ++i) spectrum[std::size_t(i)] = of_nm(band_nm(i));
    return spectrum;
}

}  // namespace

void check_optics(const SurfaceOptics& optics) {
    // At 0.3 the outermost node still has 0.14 of the mean thickness; from 0.35 on it would be < 0.
    demand_in_range(optics.thickness_spread, 0, 0.3, "thickness_spread");
    demand_in_range(optics.roughness_factor, 1, 5, "roughness_factor");
    for (const OpticalConstants* table :
         {&optics.materials.metal, &optics.materials.cuprous, &optics.materials.cupric}) {
        table->at(band_nm(0));
        table->at(band_nm(kBands - 1));
    }
}

double brown_share(double film_nm) {
    return -std::expm1(-(film_nm / kBrownNm) * (film_nm / kBrownNm));
}

const Spectrum& brown_spectrum() {
    static const Spectrum spectrum =
        per_band([](double nm) { return 0.03 + 0.06 / (1 + std::exp(-(nm - 600) / 25)); });
    return spectrum;
}

double patina_transmission(double patina_um) {
    return std::exp(-2 * patina_um / kPatinaDepthUm);
}

const Spectrum& patina_spectrum() {
    static const Spectrum spectrum = per_band([](double nm) {
        const double t = (nm - 510) / 60;
        return 0.15 + 0.30 * std::exp(-0.5 * t * t);
    });
    return spectrum;
}

std::array<ThicknessNode, 5> thickness_nodes(double spread) {
    // Zeros of the fifth Hermite polynomial, x^4 - 5 x^2 + 15/4 = 0 and 0, in closed form; the
    // weights 2^4 5! sqrt(pi) / (25 H4(x)^2) of [AbramowitzStegun1964] 25.4.46, over sqrt(pi).
    std::array<ThicknessNode, 5> nodes{};
    const double near = std::sqrt((5 - std::sqrt(10.0)) / 2);
    const double far = std::sqrt((5 + std::sqrt(10.0)) / 2);
    const std::array<double, 5> x{-far, -near, 0, near, far};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double x2 = x[i] * x[i], h4 = (16 * x2 - 48) * x2 + 12;
        nodes[i] = {1 + spread * std::numbers::sqrt2 * x[i], 16 * 120 / (25 * h4 * h4)};
    }
    return nodes;
}

UnitFilm unit_film(const SurfaceOptics& optics, double cu2o_fraction, double wavelength_nm) {
    const auto cuprous = optics.materials.cuprous.at(wavelength_nm);
    const auto cupric = optics.materials.cupric.at(wavelength_nm);
    if (optics.structure == FilmStructure::mixed) {
        return {{FilmLayer{bruggeman_index(cuprous, cupric, cu2o_fraction), 1}}, 1};
    }
    return {{FilmLayer{cupric, 1 - cu2o_fraction}, FilmLayer{cuprous, cu2o_fraction}}, 2};
}

Spectrum surface_reflectance(const SurfaceState& state, const SurfaceOptics& optics) {
    check_optics(optics);
    check(state);
    const auto nodes = thickness_nodes(optics.thickness_spread);
    const double seen_nm = state.film_nm / optics.roughness_factor;
    const double crust = optics.brown_limit ? brown_share(seen_nm) : 0;
    const double through = patina_transmission(state.patina_um);
    Spectrum spectrum{};
    for (std::size_t band = 0; band < kBands; ++band) {
        const double nm = band_nm(int(band));
        const UnitFilm unit = unit_film(optics, state.cu2o_fraction, nm);
        const auto metal = optics.materials.metal.at(nm);
        double film = 0;
        for (const ThicknessNode& node : nodes) {
            std::array<FilmLayer, 2> layers = unit.layers;
            for (FilmLayer& layer : layers) layer.thickness_nm *= node.factor * seen_nm;
            film +=
                node.weight * airy_reflectance(nm, std::span(layers).first(std::size_t(unit.count)),
                                               metal, optics.incidence);
        }
        const double bare = (1 - crust) * film + crust * brown_spectrum()[band];
        spectrum[band] = patina_spectrum()[band] + (bare - patina_spectrum()[band]) * through;
    }
    return spectrum;
}

}  // namespace verdigris
