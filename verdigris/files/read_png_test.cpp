// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <string>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/png.h"
#include "verdigris/files/test_pictures.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

bool has_note(const Statuses& notes, const std::string& id) {
    return std::any_of(notes.begin(), notes.end(), [&](const Status& s) { return s.id == id; });
}

ImageFile read_bytes(const std::vector<std::byte>& bytes) {
    const ScratchFolder folder;
    write_file(folder / "picture.bin", bytes);  // the name says nothing about the format
    const ImageInfo info = read_image_info(folder / "picture.bin");
    ImageFile file = read_image(folder / "picture.bin");
    EXPECT_EQ(info.width, file.info.width);
    EXPECT_EQ(info.height, file.info.height);
    EXPECT_EQ(info.bits, file.info.bits);
    EXPECT_EQ(info.color, file.info.color);
    EXPECT_EQ(info.format, "png");
    return file;
}

// What a PNG of `spec` must read as, given what the samples mean.
template <class P>
void expect_pixels(const PngSpec& spec, const std::function<P(int x, int y)>& expected) {
    for (const bool interlaced : {false, true}) {
        PngSpec variant = spec;
        variant.interlaced = interlaced;
        const ImageFile file = read_bytes(make_png(variant));
        ASSERT_TRUE(std::holds_alternative<Image<P>>(file.pixels));
        const auto& image = std::get<Image<P>>(file.pixels);
        ASSERT_TRUE(image.same_size(spec.width, spec.height));
        for (int y = 0; y < spec.height; ++y) {
            for (int x = 0; x < spec.width; ++x) EXPECT_EQ(image(x, y), expected(x, y));
        }
    }
}

unsigned mixed(int x, int y, int c) {
    return unsigned(x * 37 + y * 59 + c * 101);
}
std::uint8_t mixed8(int x, int y, int c) {
    return std::uint8_t(mixed(x, y, c));
}

TEST(ReadPng, ColorAndGrayInEightAndSixteenBit) {
    PngSpec spec;
    spec.sample = mixed;
    for (const int type : {PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA}) {
        spec.color_type = type;
        spec.bits = 8;
        expect_pixels<SrgbU8>(spec, [](int x, int y) {
            return SrgbU8{mixed8(x, y, 0), mixed8(x, y, 1), mixed8(x, y, 2)};
        });
    }
    spec.sample = [](int x, int y, int c) { return mixed(x, y, c) * 71; };
    spec.bits = 16;
    for (const int type : {PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA}) {
        spec.color_type = type;
        expect_pixels<SrgbU16>(spec, [&](int x, int y) {
            return SrgbU16{std::uint16_t(spec.sample(x, y, 0)), std::uint16_t(spec.sample(x, y, 1)),
                           std::uint16_t(spec.sample(x, y, 2))};
        });
    }
    for (const int type : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA}) {
        spec.color_type = type;
        expect_pixels<SrgbU16>(spec, [&](int x, int y) {
            const auto v = std::uint16_t(spec.sample(x, y, 0));
            return SrgbU16{v, v, v};
        });
    }
}

TEST(ReadPng, FewBitsAreScaledToTheFullRange) {
    for (const int bits : {1, 2, 4, 8}) {
        PngSpec spec;
        const unsigned top = (1u << bits) - 1;
        spec.bits = bits;
        spec.color_type = PNG_COLOR_TYPE_GRAY;
        spec.sample = [=](int x, int y, int) { return unsigned(x + y) & top; };
        expect_pixels<SrgbU8>(spec, [=](int x, int y) {
            const auto v = std::uint8_t((unsigned(x + y) & top) * 255 / top);
            return SrgbU8{v, v, v};
        });
    }
}

TEST(ReadPng, PalettesWithTransparency) {
    PngSpec spec;
    spec.color_type = PNG_COLOR_TYPE_PALETTE;
    spec.palette = {{1, 2, 3}, {250, 128, 0}, {9, 90, 200}};
    spec.sample = [](int x, int y, int) { return unsigned(x + y) % 3; };
    for (const int bits : {2, 4, 8}) {
        spec.bits = bits;
        for (const auto& transparency : {std::vector<std::uint8_t>{}, {0, 128}}) {
            spec.transparency = transparency;
            expect_pixels<SrgbU8>(
                spec, [&](int x, int y) { return spec.palette[std::size_t(x + y) % 3]; });
            EXPECT_EQ(has_note(read_bytes(make_png(spec)).notes, "alpha_dropped"),
                      !transparency.empty());
        }
    }
}

TEST(ReadPng, SaysHowTheColorIsKnown) {
    PngSpec spec;
    spec.sample = mixed;
    EXPECT_EQ(read_bytes(make_png(spec)).info.color, "sRGB (assumed)");
    EXPECT_EQ(read_bytes(encode_png(test_picture().view())).info.color, "sRGB");
    spec.gamma = 1 / 2.2;
    EXPECT_TRUE(read_bytes(make_png(spec)).notes.empty());
    spec.gamma = 1;
    const ImageFile linear = read_bytes(make_png(spec));
    ASSERT_TRUE(has_note(linear.notes, "gamma_ignored"));
    EXPECT_EQ(linear.notes[0].severity, Severity::caution);
    EXPECT_EQ(linear.notes[0].sentence.rfind("picture.bin: says that its samples are linear", 0),
              0u);
}

TEST(ReadPng, HonorsExif) {
    PngSpec spec;
    spec.sample = mixed;
    spec.exif = make_exif({.orientation = 6, .big_endian = true});
    const ImageFile file = read_bytes(make_png(spec));
    EXPECT_EQ(file.info.orientation, 6);
    EXPECT_EQ(file.info.width, 5);
    EXPECT_EQ(file.info.height, 7);
    EXPECT_EQ(file.info.camera, "Canon EOS R5, ISO 100, 1/125 s, f/5.6");
    // A quarter turn clockwise: the lower left corner comes up left.
    EXPECT_EQ(std::get<Image<SrgbU8>>(file.pixels)(0, 0),
              (SrgbU8{mixed8(0, 4, 0), mixed8(0, 4, 1), mixed8(0, 4, 2)}));
}

TEST(ReadPng, RefusesSizesFromTheHeader) {
    // Signature and IHDR only: nothing else may be looked at before the refusal.
    PngSpec spec;
    spec.sample = mixed;
    auto bytes = make_png(spec);
    for (const std::size_t at : {16u, 20u}) {
        for (const std::size_t i : {0u, 1u, 2u, 3u}) {
            bytes[at + i] = std::byte(65000u >> 8 * (3 - i) & 0xff);
        }
    }
    const std::uint32_t crc = [&] {
        std::uint32_t c = 0xffffffff;  // the CRC of [PNG, annex D], so that libpng agrees
        for (std::size_t i = 12; i < 29; ++i) {
            c ^= std::to_integer<std::uint32_t>(bytes[i]);
            for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >> 1) : c >> 1;
        }
        return ~c;
    }();
    for (const std::size_t i : {0u, 1u, 2u, 3u}) {
        bytes[29 + i] = std::byte(crc >> 8 * (3 - i) & 0xff);
    }
    const ScratchFolder folder;
    write_file(folder / "a.png", bytes);
    const Error error = error_of([&] { read_image(folder / "a.png"); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(error.sentence(),
              "declares 65000 x 65000 pixels, more than the 268435456 that are read");
    EXPECT_EQ(error_of([&] { read_image_info(folder / "a.png"); }).sentence(), error.sentence());
}

TEST(ReadPng, TruncatedFilesSaySo) {
    PngSpec spec;
    spec.width = spec.height = 100;
    spec.sample = mixed;
    const auto bytes = make_png(spec);
    const ScratchFolder folder;
    for (const std::size_t size : {bytes.size() - 1, bytes.size() - 12, bytes.size() / 2,
                                   std::size_t(40), std::size_t(20)}) {
        write_file(folder / "a.png", std::span(bytes).first(size));
        EXPECT_EQ(error_of([&] { read_image(folder / "a.png"); }).sentence(),
                  "is truncated: the PNG data end early");
    }
}

}  // namespace
}  // namespace verdigris
