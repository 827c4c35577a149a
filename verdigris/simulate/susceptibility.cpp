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
Image<double> reaction_pattern(const SimulationSpec& spec, const CellGrid& grid) {
    const SusceptibilitySpec& s = spec.susceptibility;
    const double longer = std::max(grid.width, grid.height);
    const int side = std::clamp(int(std::ceil(longer / s.reaction_scale * 4)), 32, 256);
    const Image<double> v =
        gray_scott(Random(spec.seed, RandomStream::reaction), side, s.feed, s.kill, s.steps);
    Image<double> pattern(grid.columns, grid.rows);
    for (int y = 0; y < grid.rows; ++y) {
        for (int x = 0; x < grid.columns; ++x) {
            const double gx = grid.x(x) / longer * side - 0.5, gy = grid.y(y) / longer * side - 0.5;
            const int x0 = std::clamp(int(std::floor(gx)), 0, side - 2);
            const int y0 = std::clamp(int(std::floor(gy)), 0, side - 2);
            const double fx = std::clamp(gx - x0, 0.0, 1.0), fy = std::clamp(gy - y0, 0.0, 1.0);
            pattern(x, y) = std::lerp(std::lerp(v(x0, y0), v(x0 + 1, y0), fx),
                                      std::lerp(v(x0, y0 + 1), v(x0 + 1, y0 + 1), fx), fy);
        }
    }
    standardize(pattern);
    return pattern;
}

}  // namespace

Image<double> susceptibility_field(const SimulationSpec& spec, const CellGrid& grid) {
    const SusceptibilitySpec& s = spec.susceptibility;
    const Image<double> broad =
        s.pattern == SusceptibilitySpec::Pattern::reaction_diffusion
            ? reaction_pattern(spec, grid)
            : sampled(GaussianField(Random(spec.seed, RandomStream::susceptibility),
                                    s.coarse * s.stretch, s.coarse),
                      grid);
    const Image<double> fine =
        sampled(GaussianField(Random(spec.seed, RandomStream::fine_susceptibility),
                              s.fine * s.stretch, s.fine),
                grid);
    // Streaks: narrow across, a whole plate long downwards.
    const Image<double> streaks =
        sampled(GaussianField(Random(spec.seed, RandomStream::drip), 0.03, 0.9), grid);
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
    Image<double> wet = sampled(GaussianField(Random(spec.seed, RandomStream::wetness), p.wet_scale,
                                              p.wet_scale * p.wet_runs),
                                grid);
    for (double& v : wet.pixels()) v = std::exp(p.wet_spread * v);
    make_mean_one(wet);
    return wet;
}

}  // namespace verdigris
