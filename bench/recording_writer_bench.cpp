// SPDX-License-Identifier: MIT
// Writing 1080p frames with camera noise: conversion alone, ours against libswscale's, and whole
// recordings of 24 frames. The counters of the conversions are the mean and the
// largest distance from the exact code, of luma and of Cb: libswscale's are its siting and
// rounding.
#include <benchmark/benchmark.h>

extern "C" {
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/recording_writer.h"
#include "verdigris/recording/testing/exact_yuv420.h"
#include "verdigris/recording/yuv420_from_srgb.h"

namespace verdigris {
namespace {

constexpr int kWidth = 1920, kHeight = 1080, kFrames = 24;

// A shaded plate with noise of one code: four frames, shown in turn.
template <class P>
const std::vector<Image<P>>& frames() {
    static const std::vector<Image<P>> made = [] {
        std::vector<Image<P>> all;
        std::mt19937 random(1);
        std::normal_distribution<float> noise(0, 1 / 255.0f);
        for (int i = 0; i < 4; ++i) {
            Image<P> image(kWidth, kHeight);
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    const float shade =
                        0.5f + 0.3f * std::sin(float(x) * 0.011f) * std::cos(float(y) * 0.013f);
                    const SrgbF c{shade + noise(random), 0.7f * shade + noise(random),
                                  0.5f * shade + noise(random)};
                    if constexpr (sizeof(P) == 3) {
                        image(x, y) = u8_from_srgb(c);
                    } else {
                        image(x, y) = u16_from_srgb(c);
                    }
                }
            }
            all.push_back(std::move(image));
        }
        return all;
    }();
    return made;
}

struct Planes {
    std::vector<std::uint8_t> y = std::vector<std::uint8_t>(std::size_t(kWidth) * kHeight);
    std::vector<std::uint8_t> cb = std::vector<std::uint8_t>(y.size() / 4), cr = cb;
};

void count_errors(benchmark::State& state, const Planes& planes) {
    const testing::ExactYuv420 exact(frames<SrgbU8>()[0]);
    const auto luma = exact.distance(0, planes.y.data(), kWidth);
    const auto cb = exact.distance(1, planes.cb.data(), kWidth / 2);
    state.counters["Y_mean"] = luma.mean;
    state.counters["Y_most"] = luma.most;
    state.counters["Cb_mean"] = cb.mean;
    state.counters["Cb_most"] = cb.most;
}

void convert(benchmark::State& state) {
    set_thread_count(int(state.range(0)));
    Planes planes;
    const Image<SrgbU8>& image = frames<SrgbU8>()[0];
    for (auto _ : state) {
        yuv420_from_srgb(image.view(),
                         {planes.y.data(), planes.cb.data(), planes.cr.data(), kWidth, kWidth / 2});
    }
    set_thread_count(0);
    count_errors(state, planes);
}

void convert_swscale(benchmark::State& state, int flags) {
    SwsContext* context = sws_alloc_context();
    const auto set = [&](const char* name, std::int64_t value) {
        if (av_opt_set_int(context, name, value, 0) < 0) throw std::runtime_error(name);
    };
    for (const char* side : {"src", "dst"}) {
        set((std::string(side) + "w").c_str(), kWidth);
        set((std::string(side) + "h").c_str(), kHeight);
    }
    set("src_format", AV_PIX_FMT_RGB24);
    set("dst_format", AV_PIX_FMT_YUV420P);
    set("src_range", 1);
    set("dst_h_chr_pos", 0);  // left-sited, in 1/256 of a luma pixel; else it takes the middle
    set("dst_v_chr_pos", 128);
    set("sws_flags", flags);
    if (sws_init_context(context, nullptr, nullptr) < 0) throw std::runtime_error("libswscale");
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(context, bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16);
    Planes planes;
    const Image<SrgbU8>& image = frames<SrgbU8>()[0];
    const std::array<const std::uint8_t*, 1> from{
        reinterpret_cast<const std::uint8_t*>(image.row(0))};
    const std::array<int, 1> from_stride{kWidth * 3};
    const std::array<std::uint8_t*, 3> to{planes.y.data(), planes.cb.data(), planes.cr.data()};
    const std::array<int, 3> to_stride{kWidth, kWidth / 2, kWidth / 2};
    for (auto _ : state) {
        sws_scale(context, from.data(), from_stride.data(), 0, kHeight, to.data(),
                  to_stride.data());
    }
    sws_freeContext(context);
    count_errors(state, planes);
}

template <class P>
void write(benchmark::State& state, const std::string& name, const std::string& preset) {
    const auto folder = std::filesystem::temp_directory_path() / "verdigris-writer-bench";
    frames<P>();
    for (auto _ : state) {
        const auto writer = write_recording(folder / name, {.width = kWidth,
                                                            .height = kHeight,
                                                            .fps = 60,
                                                            .bits = sizeof(P) == 3 ? 8 : 16,
                                                            .replace = true,
                                                            .preset = preset});
        for (int i = 0; i < kFrames; ++i) writer->add(frames<P>()[std::size_t(i % 4)]);
        writer->commit();
    }
    state.counters["frames_per_s"] =
        benchmark::Counter(kFrames * double(state.iterations()), benchmark::Counter::kIsRate);
    std::uintmax_t bytes = 0;
    if (std::filesystem::is_directory(folder / name)) {
        for (const auto& entry : std::filesystem::directory_iterator(folder / name)) {
            bytes += entry.file_size();
        }
    } else {
        bytes = std::filesystem::file_size(folder / name);
    }
    state.counters["MB_per_frame"] = double(bytes) / 1e6 / kFrames;
    std::filesystem::remove_all(folder);
}

void write8(benchmark::State& state, const std::string& name, const std::string& preset) {
    write<SrgbU8>(state, name, preset);
}
void write16(benchmark::State& state, const std::string& name, const std::string& preset) {
    write<SrgbU16>(state, name, preset);
}

BENCHMARK(convert)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(convert_swscale, as_usual, SWS_BICUBIC)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(convert_swscale, accurate_linear,
                  SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_FULL_CHR_H_INT)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(convert_swscale, accurate_cubic,
                  SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_FULL_CHR_H_INT)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
#define VERDIGRIS_WRITE(function, ...)       \
    BENCHMARK_CAPTURE(function, __VA_ARGS__) \
        ->Unit(benchmark::kMillisecond)      \
        ->UseRealTime()                      \
        ->Iterations(2)
VERDIGRIS_WRITE(write8, mp4_veryfast, "a.mp4", "veryfast");
VERDIGRIS_WRITE(write8, mp4_ultrafast, "a.mp4", "ultrafast");
VERDIGRIS_WRITE(write8, mkv, "a.mkv", "veryfast");
VERDIGRIS_WRITE(write16, mkv, "a.mkv", "veryfast");
VERDIGRIS_WRITE(write8, folder, "a/", "veryfast");
VERDIGRIS_WRITE(write16, folder, "a/", "veryfast");

}  // namespace
}  // namespace verdigris
