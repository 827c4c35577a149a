// SPDX-License-Identifier: MIT
// Scrubbing: all maps of one horizon, against a memcpy that moves as many bytes. Per pixel it reads
// base, rate and canvas (12 each), dead-zone 4, active 1, luma fill 4, and writes albedo and normal
// (12 each), roughness, metallic, height, coverage (4 each): 85 in all, so a memcpy of 42.5 reads
// and writes the same. The target is 4 times that memcpy on two cores.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <memory>

#include "verdigris/material/material.h"
#include "verdigris/material/reference.h"
#include "verdigris/pixels/parallel_rows.h"

namespace {

using namespace verdigris;

constexpr double kBytesRead = 3 * 12 + 4 + 1 + 4, kBytesWritten = 2 * 12 + 4 * 4;

struct Scene {
    MaterialRecipe recipe;
    Trajectory trajectory;
};

/// A plate with texture, a drift, a backdrop along the border and a glint.
Scene scene(int side) {
    Scene s;
    const auto plane = [side] { return Image<float>(side, side); };
    s.trajectory.base = Image<SrgbF>(side, side);
    s.trajectory.rate = Image<SrgbF>(side, side);
    s.trajectory.law = {1, 10};
    s.recipe.canvas = Image<SrgbF>(side, side);
    s.recipe.dead_zone = plane();
    s.recipe.luma_fill = plane();
    s.recipe.active = Mask(side, side);
    s.recipe.tau = 0.01;
    s.recipe.normalizer = 0.2;
    parallel_rows(side, 16, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < side; ++x) {
                const float u = 0.1f * std::sin(0.31f * float(x)) * std::cos(0.23f * float(y));
                const bool glint = x > side / 3 && x < side / 3 + side / 32;
                const bool metal = x > side / 16 && y > side / 16;
                s.trajectory.base(x, y) =
                    glint ? SrgbF{1, 1, 1} : SrgbF{0.6f + u, 0.42f + u, 0.33f};
                s.recipe.canvas(x, y) = s.trajectory.base(x, y);
                if (metal && !glint) {
                    s.trajectory.rate(x, y) = {-0.01f + 0.05f * u, 0.004f, 0.006f};
                    s.recipe.active(x, y) = kInside;
                }
                s.recipe.dead_zone(x, y) = 0.01f;
                s.recipe.luma_fill(x, y) = glint && metal ? 0.45f : -1;
            }
        }
    });
    return s;
}

double best_seconds(int runs, const std::function<void()>& body) {
    double best = 1e9;
    for (int i = 0; i < runs; ++i) {
        const auto start = std::chrono::steady_clock::now();
        body();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        best = std::min(best, took.count());
    }
    return best;
}

/// Seconds of a warm memcpy that reads and writes as many bytes as one call of materialize.
double memcpy_seconds(int side, int parts) {
    const auto bytes = std::size_t(double(side) * side * (kBytesRead + kBytesWritten) / 2) / 64 /
                       std::size_t(parts) * 64;
    const std::size_t all = bytes * std::size_t(parts);
    const std::unique_ptr<char[]> from(new char[all]), to(new char[all]);
    std::memset(from.get(), 1, all);
    std::memset(to.get(), 2, all);
    return best_seconds(9, [&] {
        parallel_for(parts, [&](int i) {
            std::memcpy(to.get() + std::size_t(i) * bytes, from.get() + std::size_t(i) * bytes,
                        bytes);
        });
    });
}

void expect_reference() {
    const Scene s = scene(200);
    Material fast;
    materialize(s.recipe, s.trajectory, 12, fast);
    Image<SrgbF> frame;
    evaluate_trajectory(s.trajectory, 12, frame);
    const double worst =
        reference::largest_difference(fast, reference::materialize(s.recipe, frame));
    if (!(worst < 1e-5)) {
        std::cerr << "the fused maps differ from the reference by " << worst << "\n";
        std::exit(1);
    }
}

void materialize_maps(benchmark::State& state) {
    expect_reference();
    const int side = int(state.range(0));
    const Scene s = scene(side);
    Material out;
    double h = 10;
    const auto scrub = [&] { materialize(s.recipe, s.trajectory, h += 0.01, out); };
    scrub();
    for (auto _ : state) scrub();
    const double best = best_seconds(7, scrub);
    constexpr int kCores = 2;
    set_thread_count(kCores);
    const double two = best_seconds(7, scrub);
    state.counters["of_memcpy_2_cores"] = two / memcpy_seconds(side, kCores);
    state.counters["of_memcpy_1_core"] = two / memcpy_seconds(side, 1);
    set_thread_count(1);
    state.counters["one_core_of_memcpy_1_core"] = best_seconds(5, scrub) / memcpy_seconds(side, 1);
    set_thread_count(0);
    state.counters["GB_per_s"] = double(side) * side * (kBytesRead + kBytesWritten) / best * 1e-9;
}
BENCHMARK(materialize_maps)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
