// SPDX-License-Identifier: MIT
// Makes the recordings that the program's tests run on:
//   verdigris_fixture plate DIR FRAMES SIDE   a copper plate that tarnishes in front of a backdrop
//   verdigris_fixture hostile DIR             one folder or file per kind of bad input
//   verdigris_fixture lpips FILE              weights of LPIPS of "squeeze" that mean nothing
//   verdigris_fixture skies DIR               surroundings as OpenEXR: good.exr and hostile ones
// Synthetic: the tarnish is a color path through thin-film colors, faster where a smooth noise
// says so. It is a test picture, not the simulator.
#include <ImfRgbaFile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/png.h"
#include "verdigris/files/safetensors.h"

namespace {
using namespace verdigris;
namespace fs = std::filesystem;

/// SplitMix64 of a lattice point: noise that is a pure function of where and when.
double hash01(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    std::uint64_t h = x * 0x9E3779B97F4A7C15u ^ y * 0xBF58476D1CE4E5B9u ^ z * 0x94D049BB133111EBu;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9u;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBu;
    return double((h ^ (h >> 31)) >> 11) * 0x1.0p-53;
}

double value_noise(double x, double y, std::uint64_t seed) {
    const double fx = std::floor(x), fy = std::floor(y);
    const auto ix = std::uint64_t(std::int64_t(fx)), iy = std::uint64_t(std::int64_t(fy));
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const double u = smooth(x - fx), v = smooth(y - fy);
    const double top = std::lerp(hash01(ix, iy, seed), hash01(ix + 1, iy, seed), u);
    const double bottom = std::lerp(hash01(ix, iy + 1, seed), hash01(ix + 1, iy + 1, seed), u);
    return std::lerp(top, bottom, v);
}

double gaussian(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    const double u = std::max(hash01(x, y, z), 1e-12), v = hash01(y, z + 77, x);
    return std::sqrt(-2 * std::log(u)) * std::cos(6.283185307179586 * v);
}

/// sRGB of a cuprous oxide film on copper, every 4 nm, computed from published n, k
/// (CuO share 1/4) at exposure 0.6.
constexpr std::array<std::array<int, 3>, 7> kPath{{{0xcf, 0xac, 0x9d},
                                                   {0xce, 0xa1, 0x89},
                                                   {0xcc, 0x8f, 0x6c},
                                                   {0xc6, 0x75, 0x48},
                                                   {0xba, 0x52, 0x23},
                                                   {0xa8, 0x27, 0x1d},
                                                   {0x8f, 0x14, 0x36}}};

SrgbF film_color(double nm) {
    const double at = std::clamp(nm / 4, 0.0, double(kPath.size()) - 1.001);
    const auto i = std::size_t(at);
    const double f = at - double(i);
    const auto mix = [&](std::size_t c) {
        return float(std::lerp(double(kPath[i][c]), double(kPath[i + 1][c]), f) / 255);
    };
    return {mix(0), mix(1), mix(2)};
}

Image<SrgbU8> plate_frame(int side, int frame, int frames) {
    Image<SrgbU8> image(side, side);
    const double lo = 0.14 * side, hi = 0.86 * side, age = double(frame) / std::max(frames - 1, 1);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double u = double(x) / side, v = double(y) / side;
            const double light = 1.04 - 0.16 * u - 0.08 * v;
            double r = 0.47, g = 0.48, b = 0.49;
            if (x >= lo && x < hi && y >= lo && y < hi) {
                const double broad =
                    value_noise(u * 4, v * 4, 1) + 0.5 * value_noise(u * 9, v * 9, 2);
                const double fine = value_noise(u * 34, v * 34, 3);
                const double susceptibility = 0.45 + 0.75 * broad + 0.25 * fine;
                const double brushed = 0.05 * (value_noise(u * 3, v * 150, 4) - 0.5);
                const SrgbF c =
                    film_color(1.5 + 8.5 * susceptibility * std::sqrt(0.03 + age) * 0.8);
                r = c.r * (0.94 + brushed);
                g = c.g * (0.94 + brushed);
                b = c.b * (0.94 + brushed);
            }
            const auto at = std::uint64_t(y) * std::uint64_t(side) + std::uint64_t(x);
            const auto channel = [&](double value, std::uint64_t c) {
                return float(value * light + 0.006 * gaussian(at, std::uint64_t(frame), c));
            };
            image(x, y) = u8_from_srgb({channel(r, 11), channel(g, 12), channel(b, 13)});
        }
    }
    return image;
}

std::string number(int i) {
    char text[16];
    std::snprintf(text, sizeof text, "%04d.png", i);
    return text;
}

void solid_folder(const fs::path& folder, int frames, SrgbU8 color) {
    Image<SrgbU8> image(48, 48);
    std::fill(image.pixels().begin(), image.pixels().end(), color);
    for (int i = 0; i < frames; ++i) write_png(folder / number(i), image);
}

// By OpenEXR itself: our own writer refuses to write a NaN.
void put_exr(const fs::path& path, const std::vector<Imf::Rgba>& pixels, int width) {
    const int height = int(pixels.size()) / width;
    fs::create_directories(path.parent_path());
    Imf::RgbaOutputFile file(path.c_str(), width, height, Imf::WRITE_RGB);
    file.setFrameBuffer(pixels.data(), 1, std::size_t(width));
    file.writePixels(height);
}

void skies(const fs::path& root) {
    std::vector<Imf::Rgba> sky(32 * 16, Imf::Rgba(0.3f, 0.4f, 0.6f));
    sky[4 * 32 + 5] = Imf::Rgba(400, 350, 300);  // a sun
    put_exr(root / "good.exr", sky, 32);
    put_exr(root / "bright.exr", std::vector<Imf::Rgba>(32 * 16, Imf::Rgba(2, 3, 4)), 32);
    put_exr(root / "black.exr", std::vector<Imf::Rgba>(32 * 16, Imf::Rgba(0, 0, 0)), 32);
    sky[77].r = std::numeric_limits<float>::quiet_NaN();
    put_exr(root / "nan.exr", sky, 32);
    sky[77].r = std::numeric_limits<float>::infinity();
    put_exr(root / "inf.exr", sky, 32);
    // Its header declares 60,000 x 30,000 pixels.
    auto bytes = read_file(root / "good.exr");
    for (const std::string name : {"dataWindow", "displayWindow"}) {
        const std::string key = name + std::string("\0box2i\0\x10\0\0\0", 11);
        const auto* text = reinterpret_cast<const char*>(bytes.data());
        const std::size_t at = std::string(text, bytes.size()).find(key) + key.size() + 8;
        const std::array<std::uint32_t, 2> most{59999, 29999};
        for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = std::byte(most[i / 4] >> (8 * (i % 4)));
    }
    write_file(root / "giant.exr", bytes);
}

void hostile(const fs::path& root) {
    fs::create_directories(root / "empty");
    write_file(root / "text.mp4", std::string_view("this is not a video, it is a letter\n"));
    write_file(root / "zero.mp4", std::string_view(""));
    solid_folder(root / "one_frame", 1, {180, 120, 90});
    solid_folder(root / "single_color", 12, {180, 120, 90});
    solid_folder(root / "all_black", 12, {0, 0, 0});
    solid_folder(root / "mixed_sizes", 6, {180, 120, 90});
    write_png(root / "mixed_sizes" / "0006.png", Image<SrgbU8>(50, 48));

    // A PNG whose header declares 65,000 x 65,000: the checksum is right, the pixels are not there.
    solid_folder(root / "huge", 3, {1, 2, 3});
    auto bytes = read_file(root / "huge" / "0001.png");
    for (std::size_t i : {std::size_t(16), std::size_t(20)}) {
        const std::uint32_t declared = 65000;
        for (std::size_t k = 0; k < 4; ++k) bytes[i + k] = std::byte(declared >> (24 - 8 * k));
    }
    std::uint32_t crc = 0xFFFFFFFFu;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= std::to_integer<std::uint32_t>(bytes[i]);
        for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (0xEDB88320u & (0u - (crc & 1)));
    }
    crc = ~crc;
    for (std::size_t k = 0; k < 4; ++k) bytes[29 + k] = std::byte(crc >> (24 - 8 * k));
    write_file(root / "huge" / "0001.png", bytes);

    for (int i = 0; i < 8; ++i) {
        std::vector<Imf::Rgba> pixels(32 * 32, Imf::Rgba(0.4f, 0.2f, 0.1f));
        if (i == 5) pixels[3 * 32 + 7].g = std::numeric_limits<float>::quiet_NaN();
        char name[16];
        std::snprintf(name, sizeof name, "%04d.exr", i);
        put_exr(root / "nan" / name, pixels, 32);
    }
    for (int i = 0; i < 12; ++i)
        write_png(root / "truncated_png" / number(i), plate_frame(96, i, 12));
    const auto whole = read_file(root / "truncated_png" / "0007.png");
    write_file(root / "truncated_png" / "0007.png", std::span(whole).first(whole.size() / 2));
}

/// Of the right names and shapes, and of sizes at which every layer still says something.
void lpips_weights(const fs::path& path) {
    SafetensorsFile file;
    file.metadata = {{"net", "squeeze"}, {"version", "0.1"}};
    const auto add = [&](const std::string& name, const std::vector<std::int64_t>& shape,
                         double low, double high) {
        std::int64_t count = 1;
        for (const std::int64_t side : shape) count *= side;
        std::vector<float> values;
        for (std::int64_t i = 0; i < count; ++i)
            values.push_back(
                float(low + (high - low) * hash01(std::uint64_t(i), file.tensors.size(), 9)));
        file.tensors.push_back(float_tensor(name, shape, values));
    };
    const auto convolution = [&](const std::string& name, int in, int out, int kernel) {
        const double spread = std::sqrt(6.0 / (in * kernel * kernel));
        add(name + ".weight", {out, in, kernel, kernel}, -spread, spread);
        add(name + ".bias", {out}, 0, 0.1);
    };
    convolution("features.0", 3, 64, 3);
    int in = 64;
    for (const auto& [index, squeezed, half] :
         std::initializer_list<std::array<int, 3>>{{3, 16, 64},
                                                   {4, 16, 64},
                                                   {6, 32, 128},
                                                   {7, 32, 128},
                                                   {9, 48, 192},
                                                   {10, 48, 192},
                                                   {11, 64, 256},
                                                   {12, 64, 256}}) {
        const std::string name = "features." + std::to_string(index);
        convolution(name + ".squeeze", in, squeezed, 1);
        convolution(name + ".expand1x1", squeezed, half, 1);
        convolution(name + ".expand3x3", squeezed, half, 3);
        in = 2 * half;
    }
    int head = 0;
    for (const int channels : {64, 128, 256, 384, 384, 512, 512})
        add("lin" + std::to_string(head++) + ".weight", {1, channels, 1, 1}, 0, 1);
    write_safetensors(path, file);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string kind = argc > 1 ? argv[1] : "";
    try {
        if (kind == "plate" && argc == 5) {
            const int frames = std::atoi(argv[3]), side = std::atoi(argv[4]);
            for (int i = 0; i < frames; ++i) {
                write_png(fs::path(argv[2]) / number(i), plate_frame(side, i, frames));
            }
            return 0;
        }
        if (kind == "skies" && argc == 3) {
            skies(argv[2]);
            return 0;
        }
        if (kind == "hostile" && argc == 3) {
            hostile(argv[2]);
            return 0;
        }
        if (kind == "lpips" && argc == 3) {
            lpips_weights(argv[2]);
            return 0;
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "verdigris_fixture: %s\n", e.what());
        return 1;
    }
    std::fprintf(
        stderr,
        "usage: verdigris_fixture plate DIR FRAMES SIDE | hostile DIR | lpips FILE | skies DIR\n");
    return 2;
}
