// SPDX-License-Identifier: MIT
// Writing a 4096 x 4096 map: ours against libpng at its default level, into memory, in one run.
// Before anything is timed, both files must decode to the picture that went in.
#include <benchmark/benchmark.h>
#include <png.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/files/png.h"
#include "verdigris/pixels/image.h"

namespace verdigris {
namespace {

constexpr int kSize = 4096;

// Smooth shading with camera noise of 1 % (2.5 codes of 8 bit), as forecast maps have it.
template <class P>
Image<P> picture() {
    auto image = Image<P>::for_overwrite(kSize, kSize);
    std::minstd_rand random(1);
    const auto noise = [&] { return 0.01f * (float(random()) / 2147483647.0f - 0.5f) * 3.46f; };
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float shade =
                0.5f + 0.3f * std::sin(float(x) * 0.004f) * std::cos(float(y) * 0.003f);
            const SrgbF c{shade + noise(), 0.8f * shade + noise(), 0.6f * shade + noise()};
            if constexpr (std::is_same_v<P, SrgbU8>) {
                image(x, y) = u8_from_srgb(c);
            } else {
                image(x, y) = u16_from_srgb(c);
            }
        }
    }
    return image;
}

using Bytes = std::vector<std::byte>;

template <class P>
Bytes libpng_encode(const Image<P>& image, int level, int filters) {
    Bytes out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &out,
        [](png_structp p, png_bytep data, png_size_t size) {
            const auto* bytes = reinterpret_cast<const std::byte*>(data);
            auto* to = static_cast<Bytes*>(png_get_io_ptr(p));
            to->insert(to->end(), bytes, bytes + size);
        },
        nullptr);
    png_set_IHDR(png, info, kSize, kSize, sizeof(P) == 3 ? 8 : 16, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (level >= 0) png_set_compression_level(png, level);
    if (filters >= 0) png_set_filter(png, PNG_FILTER_TYPE_BASE, filters);
    png_write_info(png, info);
    if (sizeof(P) == 6) png_set_swap(png);
    for (int y = 0; y < kSize; ++y) {
        png_write_row(png, reinterpret_cast<png_const_bytep>(image.row(y)));
    }
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return out;
}

// Throws unless libpng reads `file` as exactly `image`.
template <class P>
void require_same_pixels(std::span<const std::byte> file, const Image<P>& image) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_read_fn(png, &file, [](png_structp p, png_bytep to, png_size_t size) {
        auto* rest = static_cast<std::span<const std::byte>*>(png_get_io_ptr(p));
        if (rest->size() < size) png_error(p, "short");
        std::memcpy(to, rest->data(), size);
        *rest = rest->subspan(size);
    });
    png_read_info(png, info);
    if (sizeof(P) == 6) png_set_swap(png);
    std::vector<P> row(kSize);
    bool same = png_get_image_width(png, info) == kSize &&
                png_get_image_height(png, info) == kSize &&
                png_get_rowbytes(png, info) == kSize * sizeof(P);
    for (int y = 0; same && y < kSize; ++y) {
        png_read_row(png, reinterpret_cast<png_bytep>(row.data()), nullptr);
        same = std::memcmp(row.data(), image.row(y), kSize * sizeof(P)) == 0;
    }
    png_destroy_read_struct(&png, &info, nullptr);
    if (!same) throw std::runtime_error("the PNG does not decode to the picture");
}

template <class P>
const Image<P>& checked_picture() {
    static const Image<P> image = [] {
        auto made = picture<P>();
        require_same_pixels(encode_png(made.view()), made);
        require_same_pixels(libpng_encode(made, -1, -1), made);
        return made;
    }();
    return image;
}

template <class P>
void ours(benchmark::State& state) {
    const Image<P>& image = checked_picture<P>();
    std::size_t size = 0;
    for (auto _ : state) size = encode_png(image.view(), {.level = int(state.range(0))}).size();
    state.counters["MB"] = double(size) / 1e6;
}

template <class P>
void libpng_default(benchmark::State& state) {
    const Image<P>& image = checked_picture<P>();
    std::size_t size = 0;
    for (auto _ : state) size = libpng_encode(image, -1, -1).size();
    state.counters["MB"] = double(size) / 1e6;
}

// The fastest that libpng itself can be asked for with compression.
template <class P>
void libpng_level1_up(benchmark::State& state) {
    const Image<P>& image = checked_picture<P>();
    std::size_t size = 0;
    for (auto _ : state) size = libpng_encode(image, 1, PNG_FILTER_UP).size();
    state.counters["MB"] = double(size) / 1e6;
}

BENCHMARK(ours<SrgbU8>)->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(libpng_default<SrgbU8>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(libpng_level1_up<SrgbU8>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ours<SrgbU16>)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(libpng_default<SrgbU16>)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace verdigris
