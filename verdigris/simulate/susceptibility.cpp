// SPDX-License-Identifier: MIT
// The static maps of a specimen: susceptibility and wetness.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verdigris/simulate/specimen.h"

namespace verdigris {
namespace {

void make_mean_one(Image<double>& field) {
    double sum = 0;
    for (const double v : field.pixels()) sum += v;
    const double scale = double(field.pixel_count()) / sum;
    for (double& v : field.pixels()) v *= scale;
}

// The reaction's own cells, read between them: its spots have a size in sides, whatever the grid.
Image<double> reaction_pattern(const SimulationSpec& spec, const CellGrid& grid,
                               const Breathe& breathe) {
    const SusceptibilitySpec& s = spec.susceptibility;
    const double longer = std::max(grid.width, grid.height);
    const int side = std::max(16, int(std::ceil(longer / s.reaction_scale * 4)));
    const Image<double> v = gray_scott(Random(spec.pattern_seed(), RandomStream::reaction), side,
                                       s.feed, s.kill, s.steps, breathe);
    Image<double> pattern(grid.columns, grid.rows);
    const double per_side = side / longer;
    for (int y = 0; y < grid.rows; ++y) {
        for (int x = 0; x < grid.columns; ++x) {
            pattern(x, y) =
                read_between(v, grid.x(x) / s.stretch * per_side - 0.5, grid.y(y) * per_side - 0.5);
        }
    }
    standardize(pattern);
    return pattern;
}

}  // namespace

Image<double> susceptibility_field(const SimulationSpec& spec, const CellGrid& grid,
                                   const Breathe& breathe) {
    const SusceptibilitySpec& s = spec.susceptibility;
    const Image<double> broad =
        s.pattern == SusceptibilitySpec::Pattern::reaction_diffusion
            ? reaction_pattern(spec, grid, breathe)
            : sampled(GaussianField(Random(spec.pattern_seed(), RandomStream::susceptibility),
                                    s.coarse * s.stretch, s.coarse),
                      grid);
    const Image<double> fine =
        sampled(GaussianField(Random(spec.pattern_seed(), RandomStream::fine_susceptibility),
                              s.fine * s.stretch, s.fine),
                grid);
    // Streaks: narrow across, a whole plate long downwards.
    const Image<double> streaks =
        sampled(GaussianField(Random(spec.pattern_seed(), RandomStream::drip), 0.03, 0.9), grid);
    const double a = std::sqrt(1 - s.fine_share), b = std::sqrt(s.fine_share);
    Image<double> rho(grid.columns, grid.rows);
    for (int y = 0; y < grid.rows; ++y) {
        for (int x = 0; x < grid.columns; ++x) {
            const double rim = std::min(std::min(grid.x(x), grid.width - grid.x(x)),
                                        std::min(grid.y(y), grid.height - grid.y(y)));
            // Only the wet streaks count, and they begin at the top.
            const double drip = std::max(0.0, streaks(x, y)) * (1 - grid.y(y) / grid.height);
            rho(x, y) =
                std::exp(s.spread * (a * broad(x, y) + b * fine(x, y)) +
                         s.edge * std::exp(-std::max(rim, 0.0) / s.edge_width) + s.drip * drip);
        }
    }
    make_mean_one(rho);
    return rho;
}

Image<double> wetness_field(const SimulationSpec& spec, const CellGrid& grid) {
    const PatinaSpec& p = spec.patina;
    Image<double> wet = sampled(GaussianField(Random(spec.pattern_seed(), RandomStream::wetness),
                                              p.wet_scale, p.wet_scale * p.wet_runs),
                                grid);
    for (double& v : wet.pixels()) v = std::exp(p.wet_spread * v);
    make_mean_one(wet);
    return wet;
}

}  // namespace verdigris
