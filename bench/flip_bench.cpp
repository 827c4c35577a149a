// SPDX-License-Identifier: MIT
// FLIP of two 1920 x 1080 pictures in memory, everything included (map, mean, quartiles), against a
// memcpy that moves as many bytes: it reads two pictures of 12 bytes a pixel and writes a map of 4.
// Give a pair of pictures to time those instead of made ones: FLIP_PAIR=a.png:b.png
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <variant>

#include "verdigris/color/convert.h"
#include "verdigris/files/image_file.h"
#include "verdigris/metrics/metrics.h"
#include "verdigris/pixels/parallel_rows.h"

namespace {

using namespace verdigris;
constexpr int kWidth = 1920, kHeight = 1080;

struct Pair {
    Image<SrgbF> reference, test;
};

Image<SrgbF> read(const std::string& path) {
    const ImageFile file = read_image(path);
    const auto& codes = std::get<Image<SrgbU8>>(file.pixels);
    Image<SrgbF> image(codes.width(), codes.height());
    for (std::size_t i = 0; i < codes.pixel_count(); ++i)
        image.pixels()[i] = srgb_from_u8(codes.pixels()[i]);
    return image;
}

const Pair& pair() {
    static const Pair pictures = [] {
        Pair p;
        if (const char* given = std::getenv("FLIP_PAIR")) {
            const std::string names = given;
            const std::size_t colon = names.find(':');
            p.reference = read(names.substr(0, colon));
            p.test = read(names.substr(colon + 1));
            return p;
        }
        p.reference = Image<SrgbF>(kWidth, kHeight);
        p.test = Image<SrgbF>(kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const float u = 0.1f * std::sin(0.31f * float(x)) * std::cos(0.23f * float(y));
                p.reference(x, y) = {0.6f + u, 0.42f + u, 0.33f - u};
                p.test(x, y) = {0.5f + u, 0.44f + 1.2f * u, 0.36f};
            }
        }
        return p;
    }();
    return pictures;
}

void flip_of_pair(benchmark::State& state) {
    set_thread_count(int(state.range(0)));
    double mean = 0;
    for (auto _ : state) mean = flip(pair().reference, pair().test).mean;
    state.counters["mean"] = mean;
    state.counters["Mpx_per_s"] = benchmark::Counter(double(pair().test.pixel_count()) * 1e-6,
                                                     benchmark::Counter::kIsIterationInvariantRate);
    set_thread_count(0);
}

void memcpy_of_its_bytes(benchmark::State& state) {
    set_thread_count(int(state.range(0)));
    const int parts = int(state.range(0));
    const std::size_t bytes = pair().test.pixel_count() * 14 / std::size_t(parts);  // 28 moved
    const auto all = bytes * std::size_t(parts);
    const std::unique_ptr<char[]> from(new char[all]), to(new char[all]);
    std::memset(from.get(), 1, all);
    std::memset(to.get(), 2, all);
    for (auto _ : state) {
        parallel_for(parts, [&](int i) {
            std::memcpy(to.get() + std::size_t(i) * bytes, from.get() + std::size_t(i) * bytes,
                        bytes);
        });
        benchmark::ClobberMemory();
    }
    set_thread_count(0);
}

template <auto kMetric>
void metric_of_pair(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(kMetric(pair().reference, pair().test));
}

BENCHMARK(flip_of_pair)->Arg(2)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(memcpy_of_its_bytes)->Arg(2)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(metric_of_pair<ssim>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(metric_of_pair<ms_ssim>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(metric_of_pair<mean_squared_error>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(metric_of_pair<color_difference>)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
