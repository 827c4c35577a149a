// SPDX-License-Identifier: MIT
// Where the film starts, and how its islands spread.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/simulate/specimen.h"

namespace verdigris {

std::vector<Nucleus> draw_nuclei(const SimulationSpec& spec, const CellGrid& grid,
                                 const Image<double>& susceptibility) {
    // A Poisson process at the highest rate, thinned to the local one [LewisShedler1979]. chosen:
    // susceptibilities over 4 count as 4, so that the candidates do not depend on the grid.
    constexpr double kCap = 4;
    const Random random(spec.pattern_seed(), RandomStream::nuclei);
    const double rate = kCap * spec.nucleation.seeds * grid.width * grid.height;
    std::vector<Nucleus> nuclei;
    if (rate <= 0) return nuclei;
    double unit = 0;
    for (std::uint64_t i = 0;; ++i) {
        unit += -std::log1p(-random.uniform(4 * i)) / rate;
        if (unit >= spec.frames.units) return nuclei;
        const double x = random.uniform(4 * i + 1) * grid.width;
        const double y = random.uniform(4 * i + 2) * grid.height;
        const int column = std::min(int(x / grid.cell), grid.columns - 1);
        const int row = std::min(int(y / grid.cell), grid.rows - 1);
        if (random.uniform(4 * i + 3) * kCap < susceptibility(column, row))
            nuclei.push_back({unit, x, y});
    }
}

void spread_coverage(Image<double>& theta, Image<double>& scratch,
                     const Image<double>& susceptibility, const CellGrid& grid, double diffusion,
                     double growth, double step, const Breathe& breathe) {
    const auto strongest =
        *std::max_element(susceptibility.pixels().begin(), susceptibility.pixels().end());
    const double per_cell = diffusion / (grid.cell * grid.cell);
    const int parts =
        std::max(1, int(std::ceil(5 * step * std::max(per_cell, growth * strongest) - 1e-9)));
    const double d = per_cell * step / parts, a = growth * step / parts;
    const int columns = theta.width(), rows = theta.height();
    for (int part = 0; part < parts; ++part) {
        if (breathe) breathe();
        parallel_rows(rows, 32, [&](RowRun run) {
            for (int y = run.begin; y < run.end; ++y) {
                const double *here = theta.row(y), *rho = susceptibility.row(y);
                const double* above = theta.row(std::max(0, y - 1));
                const double* below = theta.row(std::min(rows - 1, y + 1));
                double* next = scratch.row(y);
                const auto cell = [&](int x, int left, int right) {
                    const double t = here[x];
                    const double flow = above[x] + below[x] + here[left] + here[right] - 4 * t;
                    next[x] = std::clamp(t + d * flow + a * rho[x] * t * (1 - t), 0.0, 1.0);
                };
                cell(0, 0, std::min(1, columns - 1));
                for (int x = 1; x < columns - 1; ++x) cell(x, x - 1, x + 1);
                if (columns > 1) cell(columns - 1, columns - 2, columns - 1);
            }
        });
        std::swap(theta, scratch);
    }
}

}  // namespace verdigris
