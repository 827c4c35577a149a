// SPDX-License-Identifier: MIT
// affinergb at the paper's size: 128 x 128, five frames, fit and ten horizons. The target is 1 ms
// on one core. The result is held against a plain scalar version before anything is timed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>

#include "verdigris/forecast/affine.h"
#include "verdigris/forecast/band_trend.h"
#include "verdigris/forecast/choose.h"
#include "verdigris/pixels/parallel_rows.h"

namespace {

using namespace verdigris;

Context recording(int side, int n) {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0, 0.001f);
    Context context;
    for (int t = 0; t < n; ++t) {
        Image<SrgbF> frame(side, side);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const float u = 0.1f * std::sin(0.11f * float(x)),
                            v = 0.1f * std::cos(0.17f * float(y));
                frame(x, y) = {0.6f + u - 0.012f * float(t) + noise(random),
                               0.42f + v + 0.004f * float(t) + noise(random),
                               0.33f - u * v * 3 + 0.002f * float(t) + noise(random)};
            }
        }
        context.frames.push_back(std::move(frame));
    }
    context.sigma = 0.001;
    context.tau = 0.0024;
    return context;
}

double channel(SrgbF c, int i) {
    return double(i == 0 ? c.r : i == 1 ? c.g : c.b);
}

/// S and s from the centered normal equations, by Gauss-Jordan in long double, two passes.
std::array<std::array<double, 4>, 3> scalar_fit(const Context& context, double lambda) {
    const int n = context.length();
    const std::size_t count = context.frames[0].pixel_count();
    long double sum_tt = 0;
    for (int t = 0; t < n; ++t) sum_tt += (t - (n - 1) / 2.0L) * (t - (n - 1) / 2.0L);
    const auto v = [&](std::size_t p, int c) {
        long double sum = 0;
        for (int t = 0; t < n; ++t) {
            sum += (t - (n - 1) / 2.0L) / sum_tt *
                   channel(context.frames[std::size_t(t)].pixels()[p], c);
        }
        return sum;
    };
    std::array<long double, 3> mx{}, mv{};
    for (std::size_t p = 0; p < count; ++p) {
        for (int c = 0; c < 3; ++c) {
            mx[std::size_t(c)] += channel(context.frames[0].pixels()[p], c) / count;
            mv[std::size_t(c)] += v(p, c) / count;
        }
    }
    long double a[3][6]{};  // [cov_x + lambda I | cov_xv]
    for (std::size_t p = 0; p < count; ++p) {
        for (int r = 0; r < 3; ++r) {
            const long double dx = channel(context.frames[0].pixels()[p], r) - mx[std::size_t(r)];
            for (int c = 0; c < 3; ++c) {
                a[r][c] +=
                    dx * (channel(context.frames[0].pixels()[p], c) - mx[std::size_t(c)]) / count;
                a[r][3 + c] += dx * (v(p, c) - mv[std::size_t(c)]) / count;
            }
        }
    }
    for (int r = 0; r < 3; ++r) a[r][r] += lambda;
    for (int k = 0; k < 3; ++k) {
        const long double pivot = a[k][k];
        for (int c = 0; c < 6; ++c) a[k][c] /= pivot;
        for (int r = 0; r < 3; ++r) {
            const long double factor = a[r][k];
            for (int c = 0; c < 6 && r != k; ++c) a[r][c] -= factor * a[k][c];
        }
    }
    std::array<std::array<double, 4>, 3> out{};
    for (std::size_t c = 0; c < 3; ++c) {
        long double bias = mv[c];
        for (std::size_t r = 0; r < 3; ++r) {
            out[c][r] = double(a[r][3 + c]);
            bias -= a[r][3 + c] * mx[r];
        }
        out[c][3] = double(bias);
    }
    return out;
}

void expect_scalar_result(const Context& context) {
    const AffineFit fit = fit_affine(context);
    const auto drift = scalar_fit(context, fit.lambda);
    double worst = 0;
    for (std::size_t r = 0; r < 3; ++r) {
        worst = std::max(worst, std::abs(fit.linear.s[r] - drift[r][3]));
        for (std::size_t c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(fit.linear.S[r][c] - drift[r][c]));
        }
    }
    const Forecast forecast = affinergb().forecast(context);
    for (double h : {1.0, 5.0, 50.0}) {
        const Image<SrgbF> fast = forecast.at(h);
        for (std::size_t p = 0; p < fast.pixel_count(); ++p) {
            const SrgbF last = context.frames.back().pixels()[p];
            double rate[3], limit = h;
            for (int c = 0; c < 3; ++c) {
                const auto& d = drift[std::size_t(c)];
                rate[c] = d[0] * channel(last, 0) + d[1] * channel(last, 1) +
                          d[2] * channel(last, 2) + d[3];
                const double room = rate[c] > 0 ? 1 - channel(last, c) : channel(last, c);
                if (rate[c] != 0) limit = std::min(limit, room / std::abs(rate[c]));
            }
            for (int c = 0; c < 3; ++c) {
                const double exact = channel(last, c) + limit * rate[c];
                worst = std::max(worst, std::abs(channel(fast.pixels()[p], c) - exact) * 0.01);
            }
        }
    }
    if (!(worst < 1e-7)) {
        std::cerr << "the fast forecast differs from the scalar one by " << worst << "\n";
        std::exit(1);
    }
}

void fit_and_ten_horizons(benchmark::State& state) {
    const Context context = recording(int(state.range(0)), int(state.range(1)));
    expect_scalar_result(context);
    set_thread_count(1);
    Image<SrgbF> out;
    for (auto _ : state) {
        const Forecast forecast = affinergb().forecast(context);
        for (int h = 1; h <= 10; ++h) evaluate_trajectory(forecast.trajectory, h, out);
        benchmark::DoNotOptimize(out.row(0));
    }
    set_thread_count(0);
}
BENCHMARK(fit_and_ten_horizons)
    ->Args({128, 5})
    ->Args({128, 10})
    ->Args({512, 10})
    ->Unit(benchmark::kMicrosecond);

void automatic_choice(benchmark::State& state) {
    const Context context = recording(int(state.range(0)), 10);
    for (auto _ : state)
        benchmark::DoNotOptimize(automatic().forecast(context).trajectory.base.row(0));
}
BENCHMARK(automatic_choice)->Arg(128)->Arg(1024)->Unit(benchmark::kMillisecond);

/// The forecast and ten horizons of it, on so many threads; without trying itself on the context.
void band_trend_and_ten_horizons(benchmark::State& state) {
    const Context context = recording(int(state.range(0)), 10);
    set_thread_count(int(state.range(1)));
    const Forecaster forecaster = band_trend({.explain = false});
    forecaster.forecast(context);  // makes the grid of models, once
    Image<SrgbF> out;
    for (auto _ : state) {
        const Forecast forecast = forecaster.forecast(context);
        for (int h = 1; h <= 10; ++h) evaluate_trajectory(forecast.trajectory, h, out);
        benchmark::DoNotOptimize(out.row(0));
    }
    set_thread_count(0);
}
BENCHMARK(band_trend_and_ten_horizons)
    ->Args({128, 1})
    ->Args({1024, 1})
    ->Args({1024, 2})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void one_horizon(benchmark::State& state) {
    const Forecast forecast = affinergb().forecast(recording(int(state.range(0)), 2));
    Image<SrgbF> out;
    double h = 0;
    for (auto _ : state) evaluate_trajectory(forecast.trajectory, h += 0.01, out);
    state.SetBytesProcessed(state.iterations() * std::int64_t(out.byte_count()) * 3);
}
BENCHMARK(one_horizon)->Arg(128)->Arg(4096)->Unit(benchmark::kMicrosecond);

}  // namespace
