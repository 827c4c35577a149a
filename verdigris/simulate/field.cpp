// SPDX-License-Identifier: MIT
#include "verdigris/simulate/field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {

GaussianField::GaussianField(const Random& random, double length_x, double length_y) {
    waves_.reserve(kWaves);
    for (std::uint64_t i = 0; i < kWaves; ++i) {
        waves_.push_back({random.gaussian(3 * i) / length_x, random.gaussian(3 * i + 1) / length_y,
                          2 * std::numbers::pi * random.uniform(6 * i + 5)});
    }
}

double GaussianField::at(double x, double y) const {
    double sum = 0;
    for (const Wave& w : waves_) sum += std::cos(w.x * x + w.y * y + w.phase);
    return sum * std::sqrt(2.0 / kWaves);
}

CellGrid cell_grid(double width, double height, int cells) {
    const double longer = std::max(width, height), shorter = std::min(width, height);
    CellGrid grid;
    grid.columns = std::max(2, int(std::ceil(cells * width / longer - 1e-9)));
    grid.rows = std::max(2, int(std::ceil(cells * height / longer - 1e-9)));
    grid.cell = longer / shorter / cells;
    grid.width = width / shorter;
    grid.height = height / shorter;
    return grid;
}

Image<double> sampled(const GaussianField& field, const CellGrid& grid) {
    Image<double> values(grid.columns, grid.rows);
    parallel_rows(grid.rows, 4, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            double* row = values.row(y);
            for (int x = 0; x < grid.columns; ++x) row[x] = field.at(grid.x(x), grid.y(y));
        }
    });
    standardize(values);
    return values;
}

void standardize(Image<double>& field) {
    double sum = 0, squares = 0;
    const double count = double(field.pixel_count());
    for (const double v : field.pixels()) sum += v;
    const double mean = sum / count;
    for (const double v : field.pixels()) squares += (v - mean) * (v - mean);
    const double deviation = std::sqrt(squares / count);
    const double scale = deviation > 1e-12 ? 1 / deviation : 0;
    for (double& v : field.pixels()) v = (v - mean) * scale;
}

double read_between(const Image<double>& cells, double column, double row) {
    const int x = std::clamp(int(std::floor(column)), 0, cells.width() - 2);
    const int y = std::clamp(int(std::floor(row)), 0, cells.height() - 2);
    const double fx = std::clamp(column - x, 0.0, 1.0), fy = std::clamp(row - y, 0.0, 1.0);
    return std::lerp(std::lerp(cells(x, y), cells(x + 1, y), fx),
                     std::lerp(cells(x, y + 1), cells(x + 1, y + 1), fx), fy);
}

Image<double> gray_scott(const Random& random, int side, double feed, double kill, int steps,
                         const Breathe& breathe) {
    constexpr float kDu = 0.16f, kDv = 0.08f;
    const float f = float(feed), k = float(kill);
    Image<float> u(side, side), v(side, side), u_next(side, side), v_next(side, side);
    std::fill(u.pixels().begin(), u.pixels().end(), 1.0f);
    // Square patches of the second substance, a twentieth of the plane each: without a start there
    // is no pattern.
    const int patch = std::max(2, side / 20);
    const int patches = std::max(8, side * side / (patch * patch * 24));
    for (int i = 0; i < patches; ++i) {
        const int left = int(random.uniform(2 * std::uint64_t(i)) * side);
        const int top = int(random.uniform(2 * std::uint64_t(i) + 1) * side);
        for (int y = 0; y < patch; ++y) {
            for (int x = 0; x < patch; ++x) {
                u((left + x) % side, (top + y) % side) = 0.5f;
                v((left + x) % side, (top + y) % side) = 0.25f;
            }
        }
    }
    const auto wrap = [side](int i) { return (i + side) % side; };
    for (int step = 0; step < steps; ++step) {
        if (breathe) breathe();
        parallel_rows(side, 64, [&](RowRun run) {
            for (int y = run.begin; y < run.end; ++y) {
                const float *u0 = u.row(y), *v0 = v.row(y);
                const float *ua = u.row(wrap(y - 1)), *va = v.row(wrap(y - 1));
                const float *ub = u.row(wrap(y + 1)), *vb = v.row(wrap(y + 1));
                float *un = u_next.row(y), *vn = v_next.row(y);
                const auto cell = [&](int x, int l, int r) {
                    const float lu = ua[x] + ub[x] + u0[l] + u0[r] - 4 * u0[x];
                    const float lv = va[x] + vb[x] + v0[l] + v0[r] - 4 * v0[x];
                    const float uvv = u0[x] * v0[x] * v0[x];
                    un[x] = u0[x] + kDu * lu - uvv + f * (1 - u0[x]);
                    vn[x] = v0[x] + kDv * lv + uvv - (f + k) * v0[x];
                };
                cell(0, side - 1, 1);
                for (int x = 1; x < side - 1; ++x) cell(x, x - 1, x + 1);
                cell(side - 1, side - 2, 0);
            }
        });
        std::swap(u, u_next);
        std::swap(v, v_next);
    }
    Image<double> pattern(side, side);
    for (std::size_t i = 0; i < pattern.pixel_count(); ++i) pattern.pixels()[i] = v.pixels()[i];
    return pattern;
}

}  // namespace verdigris
