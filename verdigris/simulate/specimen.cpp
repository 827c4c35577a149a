// SPDX-License-Identifier: MIT
#include "verdigris/simulate/specimen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verdigris/copper/optical_constants.h"
#include "verdigris/copper/patina.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 16;

EnvironmentOptions environment_of(const SimulationSpec& spec) {
    EnvironmentOptions options = spec.environment;
    options.seed = Random(spec.seed, RandomStream::environment).bits(0);
    return options;
}

SurfaceOptics optics_of(const OxideSpec& oxide) {
    SurfaceOptics optics;
    if (!oxide.metal_table.empty())
        optics.materials.metal = read_optical_constants(oxide.metal_table);
    if (!oxide.cuprous_table.empty())
        optics.materials.cuprous = read_optical_constants(oxide.cuprous_table);
    if (!oxide.cupric_table.empty())
        optics.materials.cupric = read_optical_constants(oxide.cupric_table);
    optics.thickness_spread = oxide.thickness_spread;
    optics.roughness_factor = oxide.roughness_factor;
    optics.brown_limit = oxide.brown_limit;
    return optics;
}

// The thickest film there will be: what the table of colors must reach.
double thickest(const SimulationSpec& spec, const GrowthLaw& law, const Environment& environment,
                const Image<double>& susceptibility) {
    const double rho =
        *std::max_element(susceptibility.pixels().begin(), susceptibility.pixels().end());
    const double start = spec.oxide.initial_nm * std::pow(rho, spec.oxide.initial_follows);
    const double end = law.grow(start, rho * environment.exposure(0, spec.frames.units));
    return std::clamp(end, 1000.0, 5000.0);
}

SimulationSpec checked(SimulationSpec spec) {
    check_spec(spec);
    return spec;
}

}  // namespace

CellGrid specimen_grid(const SimulationSpec& spec) {
    return cell_grid(spec.scene.width, spec.scene.height, spec.grid);
}

Specimen::Specimen(const SimulationSpec& spec, const Breathe& breathe)
    : spec_(checked(spec)),
      grid_(specimen_grid(spec)),
      environment_(environment_of(spec), spec.frames.units),
      law_(spec.oxide.growth),
      susceptibility_(susceptibility_field(spec, grid_, breathe)),
      wetness_(wetness_field(spec, grid_)),
      coverage_(grid_.columns, grid_.rows),
      scratch_(grid_.columns, grid_.rows),
      film_nm_(grid_.columns, grid_.rows),
      patina_um_(grid_.columns, grid_.rows),
      table_(optics_of(spec.oxide),
             {.most_nm = thickest(spec, law_, environment_, susceptibility_)}),
      nuclei_(draw_nuclei(spec, grid_, susceptibility_)) {
    std::fill(coverage_.pixels().begin(), coverage_.pixels().end(), spec.nucleation.initial);
    for (std::size_t i = 0; i < film_nm_.pixel_count(); ++i) {
        // What corrodes faster later has corroded faster before: the start follows rho.
        film_nm_.pixels()[i] = spec.oxide.initial_nm *
                               std::pow(susceptibility_.pixels()[i], spec.oxide.initial_follows);
    }
}

void Specimen::plant(double until) {
    const double radius = spec_.nucleation.seed_radius;
    for (; planted_ < nuclei_.size() && nuclei_[planted_].unit < until; ++planted_) {
        const Nucleus& n = nuclei_[planted_];
        // A round cap that ends at the radius; never less than one cell, or it would be lost.
        const double reach = std::max(radius, 0.75 * grid_.cell);
        const int left = std::max(0, int((n.x - reach) / grid_.cell));
        const int right = std::min(grid_.columns - 1, int((n.x + reach) / grid_.cell));
        const int top = std::max(0, int((n.y - reach) / grid_.cell));
        const int bottom = std::min(grid_.rows - 1, int((n.y + reach) / grid_.cell));
        for (int y = top; y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                const double d = std::hypot(grid_.x(x) - n.x, grid_.y(y) - n.y) / reach;
                double& theta = coverage_(x, y);
                if (d < 1) theta += (1 - theta) * (1 - d * d);
            }
        }
    }
}

void Specimen::step(double to, const Breathe& breathe) {
    const double span = to - unit_;
    const double pace = environment_.exposure(unit_, to);
    plant(to);
    if (spec_.nucleation.growth > 0 || spec_.nucleation.diffusion > 0) {
        spread_coverage(coverage_, scratch_, susceptibility_, grid_, spec_.nucleation.diffusion,
                        spec_.nucleation.growth * pace / span, span, breathe);
    }
    const bool patina = spec_.patina.growth.rate > 0;
    const double wet = span * spec_.patina.wet_share;
    parallel_rows(grid_.rows, kRowsPerRun, [&](RowRun run) {
        const std::size_t begin = std::size_t(run.begin) * std::size_t(grid_.columns);
        const std::size_t end = std::size_t(run.end) * std::size_t(grid_.columns);
        for (std::size_t i = begin; i < end; ++i) {
            const double exposure = pace * coverage_.pixels()[i] * susceptibility_.pixels()[i];
            double& film = film_nm_.pixels()[i];
            if (patina) {
                double& green = patina_um_.pixels()[i];
                green = grow_patina({.patina_um = green,
                                     .film_nm = film,
                                     .oxide_exposure = exposure,
                                     .wet_exposure = wet * wetness_.pixels()[i]},
                                    law_, spec_.patina.growth);
            }
            film = law_.grow(film, exposure);
        }
    });
    unit_ = to;
}

void Specimen::advance_to(double unit, const Breathe& breathe) {
    while (unit_ < unit) {
        // Steps end on the same marks however a caller advances, so that the coverage does too.
        const double mark = (std::floor(unit_ / kStepUnits + 1e-9) + 1) * kStepUnits;
        if (breathe) breathe();
        step(mark > unit - 1e-9 ? unit : mark, breathe);
    }
}

Image<LinearF> Specimen::color() const {
    auto image = Image<LinearF>::for_overwrite(grid_.columns, grid_.rows);
    parallel_rows(grid_.rows, kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < grid_.columns; ++x) {
                const double nm = film_nm_(x, y);
                image(x, y) = table_.at({.film_nm = nm,
                                         .cu2o_fraction = cu2o_fraction(nm, spec_.oxide.chemistry),
                                         .patina_um = patina_um_(x, y)});
            }
        }
    });
    return image;
}

}  // namespace verdigris
