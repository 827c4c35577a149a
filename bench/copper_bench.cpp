// SPDX-License-Identifier: MIT
// What a simulation of copper costs: the table it makes once, and per pixel and frame one look-up
// and one step of growth. The budget is 128 x 128 x 950 frames, 15.6 million of each, in 2 s.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <random>
#include <vector>

#include "verdigris/copper/copper.h"

namespace {

using namespace verdigris;

constexpr int kPixels = 128 * 128;

std::vector<SurfaceState> states(double most_nm) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<SurfaceState> out(kPixels);
    for (SurfaceState& state : out) state = {most_nm * unit(random), unit(random), 0};
    return out;
}

void make_table(benchmark::State& state) {
    ColorTableOptions options;
    options.fractions = int(state.range(0));
    for (auto _ : state) {
        const ColorTable table({}, options);
        benchmark::DoNotOptimize(table.at({20, 0.5, 0}));
    }
}
BENCHMARK(make_table)->Arg(5)->Arg(33)->Unit(benchmark::kMillisecond)->UseRealTime();

void look_up(benchmark::State& state) {
    const ColorTable table;
    const auto input = states(200);
    for (auto _ : state) {
        for (const SurfaceState& s : input) benchmark::DoNotOptimize(table.at(s));
    }
    state.SetItemsProcessed(state.iterations() * kPixels);
}
BENCHMARK(look_up)->Unit(benchmark::kMicrosecond);

void compute(benchmark::State& state) {
    const SurfaceOptics optics;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            linear_from_reflectance(surface_reflectance({55, 0.5, 0}, optics)));
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(compute)->Unit(benchmark::kMicrosecond);

void grow(benchmark::State& state) {
    GrowthOptions options;
    if (state.range(1) > 0) options.thin_film = ThinFilmLaw::inverse_logarithmic;
    const GrowthLaw law(options);
    const auto input = states(double(state.range(0)));
    for (auto _ : state) {
        for (const SurfaceState& s : input) benchmark::DoNotOptimize(law.grow(s.film_nm, 0.1));
    }
    state.SetItemsProcessed(state.iterations() * kPixels);
}
BENCHMARK(grow)->Args({5, 0})->Args({60, 0})->Args({5, 1})->Unit(benchmark::kMicrosecond);

}  // namespace
