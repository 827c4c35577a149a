// SPDX-License-Identifier: MIT
#include "verdigris/simulate/effort.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "verdigris/simulate/specimen.h"

namespace verdigris {

Effort estimated_effort(const SimulationSpec& spec) {
    // Nanoseconds per cell and step, pixel and frame ...: bench/simulate_bench.cpp, rounded up.
    constexpr double kCorrode = 80, kEuler = 3, kReact = 4, kPlant = 5, kPaint = 2000,
                     kCompose = 15, kExpose = 10, kEncode = 30;
    const CellGrid grid = specimen_grid(spec);
    const double cells = double(grid.columns) * grid.rows;
    const double pixels = double(spec.frames.width) * spec.frames.height;
    const double steps = std::ceil(spec.frames.units / Specimen::kStepUnits);
    // The highest of a million log-normal susceptibilities is about five deviations up.
    const double strongest =
        std::exp(5 * spec.susceptibility.spread + std::max(0.0, spec.susceptibility.edge));
    const double parts =
        std::max(1.0, 5 * Specimen::kStepUnits *
                          std::max(spec.nucleation.diffusion / (grid.cell * grid.cell),
                                   spec.nucleation.growth * strongest));
    const bool spreads = spec.nucleation.diffusion > 0 || spec.nucleation.growth > 0;
    const double nuclei = spec.nucleation.seeds * grid.width * grid.height * spec.frames.units;
    const double reach = std::max(1.0, 2 * spec.nucleation.seed_radius / grid.cell);
    const bool reacts =
        spec.susceptibility.pattern == SusceptibilitySpec::Pattern::reaction_diffusion;
    const double side = 4 * std::max(grid.width, grid.height) / spec.susceptibility.reaction_scale;
    struct Part {
        double ns;
        const char* keys;
    };
    const std::array<Part, 5> list{{
        {cells * steps * kCorrode, "grid and frames.units"},
        {spreads ? cells * steps * parts * kEuler : 0,
         "grid with nucleation.diffusion and nucleation.growth"},
        {nuclei * reach * reach * kPlant, "nucleation.seeds and nucleation.seed_radius"},
        {reacts ? side * side * spec.susceptibility.steps * kReact : 0,
         "susceptibility.steps and susceptibility.reaction_scale"},
        {pixels * (kPaint + steps * kCompose + spec.frames.count * (kExpose + kEncode)),
         "the frames' size and number"},
    }};
    Effort effort;
    double most = -1;
    for (const Part& part : list) {
        effort.hours += part.ns / 3.6e12;
        if (part.ns > most) effort.mostly = part.keys, most = part.ns;
    }
    // Frames of light, what the scene keeps, a writer's own; the cells; nuclei, while they grow.
    effort.gigabytes = (pixels * 230 + cells * 80 + nuclei * 48) / 1e9;
    return effort;
}

}  // namespace verdigris
