// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "verdigris/files/image_file.h"
#include "verdigris/files/test_pictures.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

ImageFile read_bytes(std::span<const std::byte> bytes) {
    const ScratchFolder folder;
    put_bytes(folder / "picture.bin", bytes);
    const ImageInfo info = read_image_info(folder / "picture.bin");
    ImageFile file = read_image(folder / "picture.bin");
    EXPECT_EQ(info.width, file.info.width);
    EXPECT_EQ(info.height, file.info.height);
    EXPECT_EQ(info.taken, file.info.taken);
    EXPECT_EQ(info.color, file.info.color);
    EXPECT_EQ(info.format, "jpeg");
    return file;
}

std::string sentence(std::span<const std::byte> bytes) {
    const ScratchFolder folder;
    put_bytes(folder / "picture.bin", bytes);
    return error_of([&] { read_image(folder / "picture.bin"); }).sentence();
}

// At quality 100 without subsampling only rounding is left: one step of Cb moves blue by 1.8.
void expect_close(const Image<SrgbU8>& a, const Image<SrgbU8>& b) {
    ASSERT_TRUE(a.same_size(b));
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        EXPECT_LE(std::abs(a.pixels()[i].r - b.pixels()[i].r), 3);
        EXPECT_LE(std::abs(a.pixels()[i].g - b.pixels()[i].g), 3);
        EXPECT_LE(std::abs(a.pixels()[i].b - b.pixels()[i].b), 3);
    }
}

TEST(ReadJpeg, BaselineAndProgressive) {
    const Image<SrgbU8> image = test_picture(37, 23);
    for (const bool progressive : {false, true}) {
        const ImageFile file = read_bytes(make_jpeg(image, {.progressive = progressive}));
        EXPECT_EQ(file.info.bits, 8);
        EXPECT_EQ(file.info.color, "sRGB (assumed)");
        EXPECT_TRUE(file.notes.empty());
        expect_close(std::get<Image<SrgbU8>>(file.pixels), image);
    }
}

TEST(ReadJpeg, GrayIsReplicated) {
    Image<SrgbU8> image = test_picture(16, 9);
    for (SrgbU8& c : image.pixels()) c.g = c.b = c.r;
    const ImageFile file = read_bytes(make_jpeg(image, {.gray = true}));
    expect_close(std::get<Image<SrgbU8>>(file.pixels), image);
}

TEST(ReadJpeg, OrientationTimeAndCamera) {
    const Image<SrgbU8> image = test_picture(16, 8);
    for (const bool big_endian : {false, true}) {
        const ImageFile file = read_bytes(
            make_jpeg(image, {.exif = make_exif({.orientation = 8, .big_endian = big_endian})}));
        EXPECT_EQ(file.info.width, 8);
        EXPECT_EQ(file.info.height, 16);
        EXPECT_EQ(file.info.orientation, 8);
        EXPECT_EQ(file.info.color, "sRGB");
        EXPECT_EQ(file.info.camera, "Canon EOS R5, ISO 100, 1/125 s, f/5.6");
        // 2026-03-01 12:00:00.25 at two hours ahead of UTC; 20513 days after 1970-01-01.
        EXPECT_DOUBLE_EQ(file.info.taken.value(), 20513 * 86400.0 + 10 * 3600 + 0.25);
        Image<SrgbU8> turned(8, 16);  // a quarter turn counterclockwise
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 8; ++x) turned(x, y) = image(15 - y, x);
        }
        expect_close(std::get<Image<SrgbU8>>(file.pixels), turned);
    }
}

TEST(ReadJpeg, DamagedTimesDoNotCostThePicture) {
    const auto taken = [](const ExifSpec& spec) {
        return read_bytes(make_jpeg(test_picture(), {.exif = make_exif(spec)})).info.taken;
    };
    const double noon = 20513 * 86400.0 + 12 * 3600;
    EXPECT_DOUBLE_EQ(taken({.offset = "      "}).value(), noon + 0.25);
    EXPECT_DOUBLE_EQ(taken({.subseconds = "", .offset = "rubbish"}).value(), noon);
    EXPECT_DOUBLE_EQ(taken({.subseconds = "xx", .offset = "-01:30"}).value(), noon + 5400);
    EXPECT_FALSE(taken({.date = "0000:00:00 00:00:00"}).has_value());
    EXPECT_FALSE(taken({.date = "    :  :     :  :  "}).has_value());
    // Every prefix of an EXIF block, and every byte of it broken: never more than a lost fact.
    const auto exif = make_exif();
    for (std::size_t i = 0; i < exif.size(); ++i) {
        auto broken = exif;
        broken[i] ^= std::byte(0xff);
        EXPECT_NO_THROW(read_bytes(make_jpeg(test_picture(), {.exif = broken})));
        EXPECT_NO_THROW(read_bytes(
            make_jpeg(test_picture(), {.exif = {exif.begin(), exif.begin() + long(i)}})));
    }
}

TEST(ReadJpeg, AnotherColorSpaceWithoutProfileIsACaution) {
    const ImageFile file =
        read_bytes(make_jpeg(test_picture(), {.exif = make_exif({.color_space = 65535})}));
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].id, "color_space_unknown");
    EXPECT_EQ(file.notes[0].severity, Severity::caution);
}

TEST(ReadJpeg, RefusesPrintAndTwelveBit) {
    EXPECT_EQ(sentence(make_jpeg(test_picture(), {.cmyk = true})),
              "is a JPEG for print (CMYK); convert it to RGB");
    auto bytes = make_jpeg(test_picture());
    for (std::size_t i = 2; i + 4 < bytes.size(); ++i) {
        if (bytes[i] == std::byte(0xff) && bytes[i + 1] == std::byte(0xc0)) {
            bytes[i + 4] = std::byte(12);  // the precision in the frame header [JPEG, B.2.2]
            break;
        }
    }
    EXPECT_EQ(sentence(bytes), "is a JPEG with 12 bits per sample, only 8 are read");
}

TEST(ReadJpeg, RefusesSizesFromTheHeader) {
    auto bytes = make_jpeg(test_picture());
    for (std::size_t i = 2; i + 8 < bytes.size(); ++i) {
        if (bytes[i] == std::byte(0xff) && bytes[i + 1] == std::byte(0xc0)) {
            for (const std::size_t k : {5u, 7u}) {
                bytes[i + k] = std::byte(65000 >> 8);
                bytes[i + k + 1] = std::byte(65000 & 0xff);
            }
            break;
        }
    }
    EXPECT_EQ(sentence(bytes),
              "declares 65000 x 65000 pixels, more than the 268435456 that are read");
}

TEST(ReadJpeg, TruncatedFilesSaySo) {
    for (const bool progressive : {false, true}) {
        const auto bytes = make_jpeg(test_picture(64, 64), {.progressive = progressive});
        for (const std::size_t size :
             {bytes.size() - 1, bytes.size() - 2, bytes.size() / 2, std::size_t(30)}) {
            EXPECT_EQ(sentence(std::span(bytes).first(size)),
                      "is truncated: the JPEG data end early");
        }
    }
}

TEST(ReadJpeg, DamageInsideIsACaution) {
    auto bytes = make_jpeg(test_picture(64, 64));
    // A restart marker in the middle of the scan: the decoder finds less data than it needs.
    bytes[bytes.size() - 300] = std::byte(0xff);
    bytes[bytes.size() - 299] = std::byte(0xd9);
    const ImageFile file = read_bytes(bytes);
    ASSERT_FALSE(file.notes.empty());
    EXPECT_EQ(file.notes[0].id, "damaged");
    EXPECT_EQ(file.notes[0].severity, Severity::caution);
}

}  // namespace
}  // namespace verdigris
