// SPDX-License-Identifier: MIT
#include "verdigris/copper/color_table.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>

#include "verdigris/copper/in_range.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Complex = std::complex<double>;

// Real multiplications instead of the library's operator*, which checks every product for NaN.
struct Wave {
    double re = 0, im = 0;
};
Wave operator*(Wave a, Wave b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Wave operator+(Wave a, Wave b) {
    return {a.re + b.re, a.im + b.im};
}
Wave wave(Complex c) {
    return {c.real(), c.imag()};
}

// Reflectance of a film at thicknesses 0, h, 2h, ...: every phase turns by the same factor per
// step, so a step costs products instead of exponentials. It is computed anew every kFresh steps so
// that rounding cannot pile up.
constexpr int kFresh = 64;

class Sweep {
  public:
    Sweep(const UnitFilm& unit, Complex metal, double wavelength_nm, double angle,
          Polarization polarization, double step_nm)
        : count_(unit.count) {
        Complex above = tilted_admittance(1, normal_wave_number(1, angle), polarization);
        for (int i = 0; i < count_; ++i) {
            const FilmLayer& layer = unit.layers[std::size_t(i)];
            const Complex q = normal_wave_number(layer.index, angle);
            const Complex here = tilted_admittance(layer.index, q, polarization);
            single_[std::size_t(i)] = wave((above - here) / (above + here));
            per_step_[std::size_t(i)] =
                Complex(0, 4 * std::numbers::pi) * q * layer.thickness_nm * step_nm / wavelength_nm;
            turn_[std::size_t(i)] = wave(std::exp(per_step_[std::size_t(i)]));
            above = here;
        }
        const Complex below =
            tilted_admittance(metal, normal_wave_number(metal, angle), polarization);
        single_[std::size_t(count_)] = wave((above - below) / (above + below));
    }

    double next() {
        if (step_ % kFresh == 0) {
            for (std::size_t i = 0; i < 2; ++i)
                phase_[i] = wave(std::exp(per_step_[i] * double(step_)));
        }
        ++step_;
        // r as a fraction of two waves: one division at the end instead of one per film.
        Wave top = single_[std::size_t(count_)], bottom{1, 0};
        for (std::size_t i = std::size_t(count_); i-- > 0;) {
            const Wave back = phase_[i] * top;
            top = single_[i] * bottom + back;
            bottom = bottom + single_[i] * back;
            phase_[i] = phase_[i] * turn_[i];
        }
        return (top.re * top.re + top.im * top.im) /
               (bottom.re * bottom.re + bottom.im * bottom.im);
    }

  private:
    int count_ = 0, step_ = 0;
    std::array<Wave, 3> single_{};
    std::array<Wave, 2> phase_{}, turn_{};
    std::array<Complex, 2> per_step_{};
};

// The colors of one Cu2O share at every thickness, before the brown crust.
std::vector<std::array<double, 3>> film_colors(const SurfaceOptics& optics, double fraction,
                                               int thicknesses, double step_nm, Observer observer) {
    std::vector<std::array<double, 3>> colors(std::size_t(thicknesses), {0, 0, 0});
    const auto& weights = linear_weights(observer);
    const auto spread = thickness_nodes(optics.thickness_spread);
    const ThicknessNode exact{1, 1};
    const auto nodes = optics.thickness_spread > 0 ? std::span<const ThicknessNode>(spread)
                                                   : std::span<const ThicknessNode>(&exact, 1);
    const Incidence& incidence = optics.incidence;
    const bool both = incidence.polarization == Polarization::unpolarized && incidence.angle != 0;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double nm = band_nm(int(band));
        const UnitFilm unit = unit_film(optics, fraction, nm);
        const Complex metal = optics.materials.metal.at(nm);
        const auto add = [&](Polarization polarization, const ThicknessNode& node, double share) {
            Sweep sweep(unit, metal, nm, incidence.angle, polarization,
                        step_nm * node.factor / optics.roughness_factor);
            const double weight = node.weight * share;
            for (auto& color : colors) {
                const double reflectance = weight * sweep.next();
                for (std::size_t c = 0; c < 3; ++c) color[c] += weights[c][band] * reflectance;
            }
        };
        for (const ThicknessNode& node : nodes) {
            if (both) {
                add(Polarization::s, node, 0.5);
                add(Polarization::p, node, 0.5);
            } else {
                add(incidence.polarization == Polarization::p ? Polarization::p : Polarization::s,
                    node, 1);
            }
        }
    }
    return colors;
}

}  // namespace

ColorTable::ColorTable(const SurfaceOptics& optics, const ColorTableOptions& options) {
    check_optics(optics);
    demand_in_range(options.most_nm, 1e-6, 5000, "most_nm");
    demand_in_range(options.step_nm, 0.05, 5, "step_nm");
    demand_in_range(options.fractions, 2, 129, "fractions");
    thicknesses_ = int(std::ceil(options.most_nm / options.step_nm)) + 1;
    fractions_ = options.fractions;
    per_nm_ = 1 / options.step_nm;
    patina_ = linear_from_reflectance(patina_spectrum(), options.observer);
    nodes_.resize(std::size_t(thicknesses_) * std::size_t(fractions_));
    const LinearF brown = linear_from_reflectance(brown_spectrum(), options.observer);
    parallel_for(fractions_, [&](int f) {
        const auto colors = film_colors(optics, double(f) / (fractions_ - 1), thicknesses_,
                                        options.step_nm, options.observer);
        for (std::size_t i = 0; i < colors.size(); ++i) {
            const double seen_nm = double(i) * options.step_nm / optics.roughness_factor;
            const double crust = optics.brown_limit ? brown_share(seen_nm) : 0;
            nodes_[i * std::size_t(fractions_) + std::size_t(f)] = {
                float(std::lerp(colors[i][0], double(brown.r), crust)),
                float(std::lerp(colors[i][1], double(brown.g), crust)),
                float(std::lerp(colors[i][2], double(brown.b), crust))};
        }
    });
}

LinearF ColorTable::at(const SurfaceState& state) const {
    // max(0, x) with the constant first: NaN becomes 0.
    const double x = std::min(std::max(0.0, state.film_nm * per_nm_), double(thicknesses_ - 1));
    const double y = std::min(std::max(0.0, state.cu2o_fraction), 1.0) * (fractions_ - 1);
    const int i = std::min(int(x), thicknesses_ - 2), j = std::min(int(y), fractions_ - 2);
    const float u = float(x - i), v = float(y - j);
    const LinearF* near = &nodes_[std::size_t(i) * std::size_t(fractions_) + std::size_t(j)];
    const LinearF* far = near + fractions_;
    const float a = (1 - u) * (1 - v), b = (1 - u) * v, c = u * (1 - v), d = u * v;
    const LinearF film{a * near[0].r + b * near[1].r + c * far[0].r + d * far[1].r,
                       a * near[0].g + b * near[1].g + c * far[0].g + d * far[1].g,
                       a * near[0].b + b * near[1].b + c * far[0].b + d * far[1].b};
    if (!(state.patina_um > 0)) return film;
    const float through = float(patina_transmission(state.patina_um));
    return {patina_.r + (film.r - patina_.r) * through, patina_.g + (film.g - patina_.g) * through,
            patina_.b + (film.b - patina_.b) * through};
}

}  // namespace verdigris
