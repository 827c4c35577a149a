// SPDX-License-Identifier: MIT
// Valid files of every format, cut and flipped at many fixed places: reading gives a picture or
// an Error, and nothing else. Worth most under the sanitizers.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/npy.h"
#include "verdigris/files/png.h"
#include "verdigris/files/test_pictures.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

using Bytes = std::vector<std::byte>;

// Both calls either succeed or throw an Error; anything else fails the test (or crashes it).
// Returns whether the picture could still be read.
bool survives(const std::filesystem::path& path) {
    try {
        read_image_info(path);
        read_image(path);
        return true;
    } catch (const Error& error) {
        EXPECT_FALSE(error.sentence().empty());
        EXPECT_EQ(error.where(), path.string());
        return false;
    }
}

void torture(const Bytes& valid) {
    const ScratchFolder folder;
    const auto path = folder / "a";
    put_bytes(path, valid);
    ASSERT_TRUE(survives(path));
    // chosen: every byte of the first 300, some 200 places behind them; one kind of damage each.
    const std::size_t step = std::max<std::size_t>(1, valid.size() / 200);
    int refused = 0, turn = 0;
    for (std::size_t at = 0; at < valid.size(); at += at < 300 ? 1 : step) {
        constexpr int kFlips[] = {0xff, 0x80, 0x01};
        Bytes broken = valid;
        broken[at] ^= std::byte(kFlips[turn % 3]);
        put_bytes(path, broken);
        refused += !survives(path);
        if (++turn % 4 != 0) continue;
        put_bytes(path, std::span(valid).first(at));
        refused += !survives(path);
    }
    EXPECT_GT(refused, 100);  // the damage reaches the decoders
}

Bytes png(int color_type, int bits, bool interlaced) {
    PngSpec spec;
    spec.width = 23, spec.height = 17;
    spec.color_type = color_type;
    spec.bits = bits;
    spec.interlaced = interlaced;
    if (color_type == 3) spec.palette = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    if (color_type != 3 && color_type != 0) spec.icc = make_icc_p3();
    spec.exif = make_exif();
    spec.sample = [](int x, int y, int c) { return unsigned(x * 7 + y * 5 + c) % 3; };
    return make_png(spec);
}

TEST(DamagedFiles, Png) {
    torture(png(2, 8, false));
    torture(png(6, 16, true));
    torture(png(3, 4, false));
    torture(png(0, 1, true));
}

TEST(DamagedFiles, Jpeg) {
    torture(make_jpeg(test_picture(40, 24), {.exif = make_exif()}));
    torture(make_jpeg(test_picture(40, 24),
                      {.progressive = true, .icc = make_icc_p3(), .exif = make_exif()}));
    torture(make_jpeg(test_picture(40, 24), {.gray = true, .icc = make_icc_linear_gray()}));
}

Bytes tiff(int bits, int photometric, int compression, bool tiled) {
    const ScratchFolder folder;
    make_tiff(folder / "a", [&](TIFF* t) {
        const int samples = photometric == PHOTOMETRIC_PALETTE ? 1 : 3;
        set_tiff_size(t, 40, 24, bits, samples, photometric);
        TIFFSetField(t, TIFFTAG_COMPRESSION, compression);
        if (photometric == PHOTOMETRIC_PALETTE) {
            std::vector<std::uint16_t> map(256, 7);
            TIFFSetField(t, TIFFTAG_COLORMAP, map.data(), map.data(), map.data());
        }
        if (photometric == PHOTOMETRIC_YCBCR) {
            TIFFSetField(t, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
        }
        std::vector<std::uint8_t> data(1 << 16);
        for (std::size_t i = 0; i < data.size(); ++i) data[i] = std::uint8_t(i * 7 >> 3);
        if (tiled) {
            TIFFSetField(t, TIFFTAG_TILEWIDTH, 16);
            TIFFSetField(t, TIFFTAG_TILELENGTH, 16);
            for (std::uint32_t y = 0; y < 24; y += 16) {
                for (std::uint32_t x = 0; x < 40; x += 16) {
                    TIFFWriteTile(t, data.data(), x, y, 0, 0);
                }
            }
            return;
        }
        TIFFSetField(t, TIFFTAG_ROWSPERSTRIP, 16);
        for (std::uint32_t y = 0; y < 24; ++y) TIFFWriteScanline(t, data.data() + y * 64, y, 0);
    });
    return read_file(folder / "a");
}

TEST(DamagedFiles, Tiff) {
    torture(tiff(8, PHOTOMETRIC_RGB, COMPRESSION_NONE, false));
    torture(tiff(16, PHOTOMETRIC_RGB, COMPRESSION_LZW, true));
    torture(tiff(8, PHOTOMETRIC_PALETTE, COMPRESSION_ADOBE_DEFLATE, false));
    torture(tiff(8, PHOTOMETRIC_YCBCR, COMPRESSION_JPEG, false));
}

TEST(DamagedFiles, Exr) {
    const ScratchFolder folder;
    Image<LinearF> rgb(40, 40);
    Image<float> height(40, 40);
    for (std::size_t i = 0; i < height.pixel_count(); ++i) {
        const float v = float(i % 41) / 41;
        height.pixels()[i] = v;
        rgb.pixels()[i] = {v, 1 - v, v * v};
    }
    write_exr(folder / "rgb", rgb);
    torture(read_file(folder / "rgb"));
    write_exr(folder / "height", height);
    torture(read_file(folder / "height"));
}

TEST(DamagedFiles, TablesAndArrays) {
    const ScratchFolder folder;
    const auto path = folder / "a";
    const auto each = [&](const std::string& valid, const std::function<void()>& read) {
        for (std::size_t at = 0; at < valid.size(); ++at) {
            for (const int flip : {0, 0xff, 0x80, 0x01, 0x0a}) {
                std::string broken = valid;
                if (flip == 0) broken.resize(at);
                if (flip != 0) broken[at] = char(broken[at] ^ flip);
                put_bytes(path, std::as_bytes(std::span(broken.data(), broken.size())));
                try {
                    read();
                } catch (const Error& error) {
                    EXPECT_FALSE(error.sentence().empty());
                }
            }
        }
    };
    each("# c\nfile,time\r\n\"a\"\"b\",2026-03-01T12:00:00.5+02:00\nc,1e3\n", [&] {
        for (const auto& row : read_csv(path).rows) seconds_from_text(row[1]);
    });
    const std::vector<float> values(6, 1.0f);
    write_npy(path, NpyType::f32, {2, 3}, std::as_bytes(std::span(values)));
    each(read_text(path), [&] { NpyFile(path).values<float>(); });
    write_png(path, Mask(20, 20));
    each(read_text(path), [&] { read_gray_png(path); });
}

}  // namespace
}  // namespace verdigris
