// SPDX-License-Identifier: MIT
#include "verdigris/files/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// Smooth with noise: all code values, and rows that differ.
template <class T>
T sample(int x, int y, int c) {
    constexpr double top = double(std::numeric_limits<T>::max());
    std::minstd_rand random(unsigned(x * 7919 + y * 104729 + c * 31 + 1));
    const double smooth = 0.5 + 0.4 * std::sin(x * 0.05 + c) * std::cos(y * 0.07);
    return T(std::clamp(smooth + 0.02 * (double(random() % 1000) / 1000 - 0.5), 0.0, 1.0) * top);
}
template <class P>
Image<P> picture(int width, int height) {
    Image<P> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if constexpr (std::is_integral_v<P>) {
                image(x, y) = sample<P>(x, y, 0);
            } else {
                auto& [r, g, b] = image(x, y);
                using S = std::remove_reference_t<decltype(r)>;
                r = sample<S>(x, y, 0), g = sample<S>(x, y, 1), b = sample<S>(x, y, 2);
            }
        }
    }
    return image;
}

// The reference decoder: libpng's simplified API for 8 bit, and its plain one for 16.
std::vector<std::byte> libpng_samples(std::span<const std::byte> file, int bits, int channels) {
    struct Source {
        std::span<const std::byte> rest;
    } source{file};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_read_fn(png, &source, [](png_structp p, png_bytep to, png_size_t size) {
        auto* s = static_cast<Source*>(png_get_io_ptr(p));
        if (s->rest.size() < size) png_error(p, "short");
        std::memcpy(to, s->rest.data(), size);
        s->rest = s->rest.subspan(size);
    });
    png_read_info(png, info);
    EXPECT_EQ(png_get_bit_depth(png, info), bits);
    EXPECT_EQ(png_get_channels(png, info), channels);
    if (bits == 16) png_set_swap(png);
    const std::size_t row_bytes = png_get_rowbytes(png, info);
    std::vector<std::byte> samples(row_bytes * png_get_image_height(png, info));
    for (std::size_t at = 0; at < samples.size(); at += row_bytes) {
        png_read_row(png, reinterpret_cast<png_bytep>(samples.data() + at), nullptr);
    }
    png_read_end(png, nullptr);
    EXPECT_TRUE(source.rest.empty());
    png_destroy_read_struct(&png, &info, nullptr);
    return samples;
}

template <class P>
void expect_round_trip(int bits, int channels) {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 200}, {257, 130}}) {
        const Image<P> image = picture<P>(width, height);
        for (const int level : {1, 6, 12}) {
            const auto file = encode_png(image.view(), {.level = level});
            const auto samples = libpng_samples(file, bits, channels);
            ASSERT_EQ(samples.size(), image.byte_count());
            EXPECT_EQ(std::memcmp(samples.data(), image.row(0), samples.size()), 0)
                << width << "x" << height << " level " << level;
        }
    }
}

TEST(Png, RoundTripsThroughLibpng) {
    expect_round_trip<SrgbU8>(8, 3);
    expect_round_trip<SrgbU16>(16, 3);
    expect_round_trip<Vec3U8>(8, 3);
    expect_round_trip<Vec3U16>(16, 3);
    expect_round_trip<std::uint8_t>(8, 1);
    expect_round_trip<std::uint16_t>(16, 1);
}

TEST(Png, AWindowIsEncodedAsItsOwnPicture) {
    const Image<SrgbU8> image = picture<SrgbU8>(40, 30);
    const auto window = image.view().window({5, 6, 20, 10});
    Image<SrgbU8> copy(20, 10);
    for (int y = 0; y < 10; ++y) std::copy_n(window.row(y), 20, copy.row(y));
    EXPECT_EQ(encode_png(window), encode_png(copy.view()));
}

std::map<std::string, std::string> chunks(std::span<const std::byte> file) {
    std::map<std::string, std::string> found;
    const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
    for (std::size_t at = 8; at + 12 <= text.size();) {
        std::uint32_t length = 0;
        for (int i = 0; i < 4; ++i) length = length << 8 | std::uint8_t(text[at + std::size_t(i)]);
        found[text.substr(at + 4, 4)] += text.substr(at + 8, length);
        at += 12 + length;
    }
    return found;
}

TEST(Png, ColorIsTaggedAndDataAreNot) {
    const auto color8 = chunks(encode_png(picture<SrgbU8>(4, 4).view()));
    const auto color16 = chunks(encode_png(picture<SrgbU16>(4, 4).view()));
    for (const auto& found : {color8, color16}) {
        EXPECT_EQ(found.at("sRGB"), std::string(1, '\0'));
        EXPECT_EQ(found.at("gAMA"), std::string("\x00\x00\xb1\x8f", 4));
        EXPECT_EQ(found.at("cHRM").size(), 32u);
        EXPECT_EQ(found.at("cHRM").substr(0, 4), std::string("\x00\x00\x7a\x26", 4));
    }
    for (const auto& found : {chunks(encode_png(picture<Vec3U8>(4, 4).view())),
                              chunks(encode_png(picture<Vec3U16>(4, 4).view())),
                              chunks(encode_png(picture<std::uint8_t>(4, 4).view())),
                              chunks(encode_png(picture<std::uint16_t>(4, 4).view()))}) {
        EXPECT_EQ(found.size(), 3u);  // IHDR, IDAT, IEND
        EXPECT_TRUE(found.contains("IDAT"));
    }
}

TEST(Png, CarriesText) {
    const std::string xmp = "<x:xmpmeta>gr\xc3\xbcn</x:xmpmeta>";
    const auto file = encode_png(picture<std::uint8_t>(4, 4).view(),
                                 {.level = 1, .text = {{"XML:com.adobe.xmp", xmp}}});
    EXPECT_EQ(chunks(file).at("iTXt"), "XML:com.adobe.xmp" + std::string(5, '\0') + xmp);
    libpng_samples(file, 8, 1);  // libpng checks the chunk's CRC
    for (const PngText& bad :
         {PngText{"", "x"}, PngText{std::string(80, 'k'), "x"}, PngText{"a\nb", "x"},
          PngText{" a", "x"}, PngText{"k", std::string(1, '\0')}}) {
        EXPECT_EQ(error_of([&] {
                      encode_png(picture<std::uint8_t>(4, 4).view(), {.level = 1, .text = {bad}});
                  }).code(),
                  ErrorCode::usage);
    }
}

TEST(Png, SameBytesAtAnyThreadCount) {
    const Image<SrgbU16> image = picture<SrgbU16>(600, 500);
    set_thread_count(1);
    const auto one = encode_png(image.view());
    set_thread_count(0);
    EXPECT_EQ(one, encode_png(image.view()));
}

TEST(Png, RefusesWhatNoPngCanHold) {
    const Image<std::uint8_t> image(2, 2);
    EXPECT_EQ(error_of([] { encode_png(ImageView<const std::uint8_t>()); }).code(),
              ErrorCode::failed);
    for (const int level : {0, 13, -1}) {
        EXPECT_EQ(error_of([&] { encode_png(image.view(), {.level = level}); }).sentence(),
                  "PNG compression level " + std::to_string(level) + " is not in 1..12");
    }
    const ScratchFolder folder;
    EXPECT_EQ(error_of([&] { write_png(folder / "a.png", image, {.level = 0}); }).where(),
              (folder / "a.png").string());
    EXPECT_EQ(error_of([&] { write_png(folder.path(), image); }).sentence(),
              "cannot be written: it is a folder");
    EXPECT_EQ(entry_count(folder.path()), 0);
}

TEST(ReadGrayPng, RoundTripsMasksOnly) {
    const ScratchFolder folder;
    const Image<std::uint8_t> mask = picture<std::uint8_t>(33, 21);
    write_png(folder / "mask.png", mask);
    const Image<std::uint8_t> read = read_gray_png(folder / "mask.png");
    ASSERT_TRUE(read.same_size(mask));
    EXPECT_TRUE(std::equal(read.pixels().begin(), read.pixels().end(), mask.pixels().begin()));

    const auto sentence = [&] {
        return error_of([&] { read_gray_png(folder / "mask.png"); }).sentence();
    };
    const auto bytes = read_file(folder / "mask.png");
    write_file(folder / "mask.png", std::span(bytes).first(bytes.size() / 2));
    EXPECT_EQ(sentence(), "is truncated: the PNG data end early");
    write_file(folder / "mask.png", std::span(bytes).first(bytes.size() - 12));
    EXPECT_EQ(sentence(), "is truncated: the PNG data end early");
    write_png(folder / "mask.png", picture<std::uint16_t>(3, 3));
    EXPECT_EQ(sentence(), "is not a single-channel 8-bit PNG");
    write_png(folder / "mask.png", picture<SrgbU8>(3, 3));
    EXPECT_EQ(sentence(), "is not a single-channel 8-bit PNG");
    write_file(folder / "mask.png", "P5 3 3 255");
    EXPECT_EQ(sentence(), "is not a PNG");
    write_file(folder / "mask.png", "");
    EXPECT_EQ(sentence(), "is empty");
}

}  // namespace
}  // namespace verdigris
