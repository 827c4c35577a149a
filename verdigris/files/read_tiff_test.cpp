// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/test_pictures.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

template <class P>
void write_rows(TIFF* tiff, const Image<P>& image) {
    for (int y = 0; y < image.height(); ++y) {
        Image<P> row(image.width(), 1);  // libtiff may swap in place
        std::copy_n(image.row(y), image.width(), row.row(0));
        TIFFWriteScanline(tiff, row.row(0), std::uint32_t(y), 0);
    }
}

ImageFile read_checked(const std::filesystem::path& path) {
    const ImageInfo info = read_image_info(path);
    ImageFile file = read_image(path);
    EXPECT_EQ(info.width, file.info.width);
    EXPECT_EQ(info.bits, file.info.bits);
    EXPECT_EQ(info.taken, file.info.taken);
    EXPECT_EQ(info.format, "tiff");
    return file;
}

template <class P>
void expect_equal(const ImageFile& file, const Image<P>& expected) {
    ASSERT_TRUE(std::holds_alternative<Image<P>>(file.pixels));
    const auto& image = std::get<Image<P>>(file.pixels);
    ASSERT_TRUE(image.same_size(expected));
    EXPECT_TRUE(
        std::equal(image.pixels().begin(), image.pixels().end(), expected.pixels().begin()));
}

template <class P>
void strips_and_tiles(const Image<P>& image, const char* mode, int compression) {
    constexpr int kBits = sizeof(P) == 3 ? 8 : 16;
    const ScratchFolder folder;
    make_tiff(
        folder / "strips",
        [&](TIFF* tiff) {
            set_tiff_size(tiff, image.width(), image.height(), kBits, 3, PHOTOMETRIC_RGB);
            TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
            TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 4);
            write_rows(tiff, image);
        },
        mode);
    expect_equal(read_checked(folder / "strips"), image);
    make_tiff(
        folder / "tiles",
        [&](TIFF* tiff) {
            set_tiff_size(tiff, image.width(), image.height(), kBits, 3, PHOTOMETRIC_RGB);
            TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
            TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 16);
            TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
            for (int ty = 0; ty < image.height(); ty += 16) {
                for (int tx = 0; tx < image.width(); tx += 16) {
                    Image<P> tile(16, 16);
                    for (int y = 0; y < std::min(16, image.height() - ty); ++y) {
                        std::copy_n(image.row(ty + y) + tx, std::min(16, image.width() - tx),
                                    tile.row(y));
                    }
                    TIFFWriteTile(tiff, tile.row(0), std::uint32_t(tx), std::uint32_t(ty), 0, 0);
                }
            }
        },
        mode);
    expect_equal(read_checked(folder / "tiles"), image);
}

TEST(ReadTiff, StripsAndTilesInEveryByteOrder) {
    for (const char* mode : {"wl", "wb", "w8"}) {
        for (const int compression :
             {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
            strips_and_tiles(test_picture(37, 21), mode, compression);
            strips_and_tiles(test_picture16(37, 21), mode, compression);
        }
    }
}

TEST(ReadTiff, SeparatePlanes) {
    const ScratchFolder folder;
    const Image<SrgbU16> image = test_picture16(9, 6);
    make_tiff(folder / "a", [&](TIFF* tiff) {
        set_tiff_size(tiff, 9, 6, 16, 3, PHOTOMETRIC_RGB);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_SEPARATE);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
        for (int c = 0; c < 3; ++c) {
            for (int y = 0; y < 6; ++y) {
                std::uint16_t row[9];
                for (int x = 0; x < 9; ++x) {
                    const SrgbU16 p = image(x, y);
                    row[x] = c == 0 ? p.r : c == 1 ? p.g : p.b;
                }
                TIFFWriteScanline(tiff, row, std::uint32_t(y), std::uint16_t(c));
            }
        }
    });
    expect_equal(read_checked(folder / "a"), image);
}

TEST(ReadTiff, GrayBothWaysAndWithAlpha) {
    const ScratchFolder folder;
    for (const int photometric : {PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_MINISWHITE}) {
        for (const int samples : {1, 2}) {
            Image<SrgbU16> expected(5, 3);
            make_tiff(folder / "a", [&](TIFF* tiff) {
                set_tiff_size(tiff, 5, 3, 16, samples, photometric);
                for (int y = 0; y < 3; ++y) {
                    std::vector<std::uint16_t> row;
                    for (int x = 0; x < 5; ++x) {
                        const auto v = std::uint16_t(1000 + 7000 * x + 999 * y);
                        const auto shown =
                            photometric == PHOTOMETRIC_MINISWHITE ? std::uint16_t(65535 - v) : v;
                        row.push_back(v);
                        if (samples == 2) row.push_back(42);
                        expected(x, y) = {shown, shown, shown};
                    }
                    TIFFWriteScanline(tiff, row.data(), std::uint32_t(y), 0);
                }
            });
            const ImageFile file = read_checked(folder / "a");
            expect_equal(file, expected);
            EXPECT_EQ(file.notes.size(), std::size_t(samples - 1));
        }
    }
}

TEST(ReadTiff, PaletteAndOneBit) {
    const ScratchFolder folder;
    Image<SrgbU8> expected(8, 2);
    make_tiff(folder / "palette", [&](TIFF* tiff) {
        set_tiff_size(tiff, 8, 2, 8, 1, PHOTOMETRIC_PALETTE);
        std::vector<std::uint16_t> r(256), g(256), b(256);
        for (unsigned i = 0; i < 256; ++i) {
            r[i] = std::uint16_t(i * 257), g[i] = std::uint16_t((255 - i) * 257), b[i] = 257 * 7;
        }
        TIFFSetField(tiff, TIFFTAG_COLORMAP, r.data(), g.data(), b.data());
        for (int y = 0; y < 2; ++y) {
            std::uint8_t row[8];
            for (int x = 0; x < 8; ++x) {
                row[x] = std::uint8_t(x * 20 + y);
                expected(x, y) = {row[x], std::uint8_t(255 - row[x]), 7};
            }
            TIFFWriteScanline(tiff, row, std::uint32_t(y), 0);
        }
    });
    expect_equal(read_checked(folder / "palette"), expected);
    make_tiff(folder / "bits", [&](TIFF* tiff) {
        set_tiff_size(tiff, 8, 2, 1, 1, PHOTOMETRIC_MINISBLACK);
        for (int y = 0; y < 2; ++y) {
            std::uint8_t row = y == 0 ? 0xa5 : 0x0f;
            for (int x = 0; x < 8; ++x) {
                const std::uint8_t v = row >> (7 - x) & 1 ? 255 : 0;
                expected(x, y) = {v, v, v};
            }
            TIFFWriteScanline(tiff, &row, std::uint32_t(y), 0);
        }
    });
    expect_equal(read_checked(folder / "bits"), expected);
}

TEST(ReadTiff, JpegInsideInYcbcr) {
    const ScratchFolder folder;
    const Image<SrgbU8> image = test_picture(32, 16);
    make_tiff(folder / "a", [&](TIFF* tiff) {
        set_tiff_size(tiff, 32, 16, 8, 3, PHOTOMETRIC_YCBCR);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_JPEG);
        TIFFSetField(tiff, TIFFTAG_JPEGQUALITY, 100);
        TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
        TIFFSetField(tiff, TIFFTAG_YCBCRSUBSAMPLING, 1, 1);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 16);
        write_rows(tiff, image);
    });
    const ImageFile file = read_checked(folder / "a");
    const auto& read = std::get<Image<SrgbU8>>(file.pixels);
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        EXPECT_LE(std::abs(read.pixels()[i].r - image.pixels()[i].r), 3);
        EXPECT_LE(std::abs(read.pixels()[i].b - image.pixels()[i].b), 3);
    }
}

TEST(ReadTiff, OrientationTimeAndCamera) {
    const ScratchFolder folder;
    const Image<SrgbU8> image = test_picture(6, 4);
    make_tiff(folder / "a", [&](TIFF* tiff) {
        set_tiff_size(tiff, 6, 4, 8, 3, PHOTOMETRIC_RGB);
        TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_BOTRIGHT);
        TIFFSetField(tiff, TIFFTAG_MAKE, "Nikon");
        TIFFSetField(tiff, TIFFTAG_MODEL, "Z 9");
        write_rows(tiff, image);
        TIFFWriteDirectory(tiff);
        TIFFCreateEXIFDirectory(tiff);
        TIFFSetField(tiff, EXIFTAG_DATETIMEORIGINAL, "2026:03:01 12:00:00");
        TIFFSetField(tiff, EXIFTAG_SUBSECTIMEORIGINAL, "5");
        TIFFSetField(tiff, EXIFTAG_OFFSETTIMEORIGINAL, "-01:00");
        TIFFSetField(tiff, EXIFTAG_EXPOSURETIME, 0.5);
        TIFFSetField(tiff, EXIFTAG_FNUMBER, 8.0);
        const std::uint16_t iso = 200;
        TIFFSetField(tiff, EXIFTAG_ISOSPEEDRATINGS, 1, &iso);
        std::uint64_t offset = 0;
        TIFFWriteCustomDirectory(tiff, &offset);
        TIFFSetDirectory(tiff, 0);
        TIFFSetField(tiff, TIFFTAG_EXIFIFD, offset);
        TIFFRewriteDirectory(tiff);
    });
    const ImageFile file = read_checked(folder / "a");
    EXPECT_EQ(file.info.orientation, 3);
    EXPECT_DOUBLE_EQ(file.info.taken.value(), 20513 * 86400.0 + 13 * 3600 + 0.5);
    EXPECT_EQ(file.info.camera, "Nikon Z 9, ISO 200, 0.5 s, f/8");
    Image<SrgbU8> turned(6, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 6; ++x) turned(x, y) = image(5 - x, 3 - y);
    }
    expect_equal(file, turned);
}

TEST(ReadTiff, RefusesWhatItCannotReadRight) {
    const ScratchFolder folder;
    const auto sentence = [&](const std::function<void(TIFF*)>& change) {
        make_tiff(folder / "a", [&](TIFF* tiff) {
            set_tiff_size(tiff, 7, 5, 8, 3, PHOTOMETRIC_RGB);
            change(tiff);
            std::vector<std::byte> row(1 << 20);
            for (std::uint32_t y = 0; y < 5; ++y) TIFFWriteScanline(tiff, row.data(), y, 0);
        });
        return error_of([&] { read_image(folder / "a"); }).sentence();
    };
    EXPECT_EQ(sentence([](TIFF* t) {
                  TIFFSetField(t, TIFFTAG_BITSPERSAMPLE, 32);
                  TIFFSetField(t, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
              }),
              "is a TIFF with floating-point samples; save it as OpenEXR");
    EXPECT_EQ(sentence([](TIFF* t) { TIFFSetField(t, TIFFTAG_BITSPERSAMPLE, 32); }),
              "is a TIFF with 32 bits per sample; 8 and 16 are read");
    EXPECT_EQ(sentence([](TIFF* t) {
                  TIFFSetField(t, TIFFTAG_SAMPLESPERPIXEL, 4);
                  TIFFSetField(t, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_SEPARATED);
              }),
              "is a TIFF for print (CMYK); convert it to RGB");
    EXPECT_EQ(sentence([](TIFF* t) {
                  TIFFSetField(t, TIFFTAG_SAMPLESPERPIXEL, 1);
                  TIFFSetField(t, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_CFA);
              }),
              "is a camera raw file; develop it to 16-bit TIFF");
    EXPECT_EQ(sentence([](TIFF* t) {
                  TIFFSetField(t, TIFFTAG_IMAGEWIDTH, 65000);
                  TIFFSetField(t, TIFFTAG_IMAGELENGTH, 65000);
              }),
              "declares 65000 x 65000 pixels, more than the 268435456 that are read");
}

TEST(ReadTiff, TruncatedFilesSaySo) {
    const ScratchFolder folder;
    make_tiff(folder / "a", [&](TIFF* tiff) {
        set_tiff_size(tiff, 64, 64, 8, 3, PHOTOMETRIC_RGB);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 8);
        TIFFWriteCheck(tiff, 0, "");
        TIFFWriteDirectory(tiff);  // the directory first, so that a cut costs pixels
        TIFFSetDirectory(tiff, 0);
        write_rows(tiff, test_picture(64, 64));
    });
    const auto bytes = read_file(folder / "a");
    for (const std::size_t size : {std::size_t(6), bytes.size() / 2}) {
        write_file(folder / "b", std::span(bytes).first(size));
        EXPECT_EQ(error_of([&] { read_image(folder / "b"); }).sentence(),
                  "is truncated: the TIFF data end early");
    }
}

TEST(ReadTiff, SeveralPagesAreNoted) {
    const ScratchFolder folder;
    make_tiff(folder / "a", [&](TIFF* tiff) {
        for (int page = 0; page < 2; ++page) {
            set_tiff_size(tiff, 7, 5, 8, 3, PHOTOMETRIC_RGB);
            write_rows(tiff, test_picture());
            TIFFWriteDirectory(tiff);
        }
    });
    const ImageFile file = read_checked(folder / "a");
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].sentence, "a: holds several pictures; the first is read");
}

}  // namespace
}  // namespace verdigris
