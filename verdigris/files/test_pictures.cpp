// SPDX-License-Identifier: MIT
#include "verdigris/files/test_pictures.h"

#include <csetjmp>
#include <cstdio>
//
#include <jpeglib.h>
#include <lcms2.h>
#include <png.h>

#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace verdigris {
namespace {

std::vector<std::byte> bytes_of(const void* data, std::size_t size) {
    const auto* start = static_cast<const std::byte*>(data);
    return {start, start + size};
}

int channel_count(int color_type) {
    const int colors = (color_type & PNG_COLOR_MASK_COLOR) && color_type != 3 ? 3 : 1;
    return colors + (color_type & PNG_COLOR_MASK_ALPHA ? 1 : 0);
}

std::vector<std::byte> saved(cmsHPROFILE profile) {
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::vector<std::byte> bytes(size);
    cmsSaveProfileToMem(profile, bytes.data(), &size);
    cmsCloseProfile(profile);
    return bytes;
}

void name_profile(cmsHPROFILE profile, const char* name) {
    cmsMLU* text = cmsMLUalloc(nullptr, 1);
    cmsMLUsetASCII(text, "en", "US", name);
    cmsWriteTag(profile, cmsSigProfileDescriptionTag, text);
    cmsMLUfree(text);
}

}  // namespace

Image<SrgbU8> test_picture(int width, int height) {
    Image<SrgbU8> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image(x, y) = {std::uint8_t(30 + x * 20), std::uint8_t(200 - y * 25),
                           std::uint8_t(60 + x * 7 + y * 11)};
        }
    }
    return image;
}

Image<SrgbU16> test_picture16(int width, int height) {
    Image<SrgbU16> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image(x, y) = {std::uint16_t(1000 + x * 5003), std::uint16_t(60000 - y * 7001),
                           std::uint16_t(300 + x * 997 + y * 3011)};
        }
    }
    return image;
}

std::vector<std::byte> make_png(const PngSpec& spec) {
    std::vector<std::byte> out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &out,
        [](png_structp p, png_bytep data, png_size_t size) {
            const auto bytes = bytes_of(data, size);
            auto* to = static_cast<std::vector<std::byte>*>(png_get_io_ptr(p));
            to->insert(to->end(), bytes.begin(), bytes.end());
        },
        nullptr);
    png_set_IHDR(png, info, png_uint_32(spec.width), png_uint_32(spec.height), spec.bits,
                 spec.color_type, spec.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette;
    for (const SrgbU8 c : spec.palette) palette.push_back({c.r, c.g, c.b});
    if (!palette.empty()) png_set_PLTE(png, info, palette.data(), int(palette.size()));
    if (!spec.transparency.empty()) {
        png_set_tRNS(png, info, spec.transparency.data(), int(spec.transparency.size()), nullptr);
    }
    if (spec.gamma > 0) png_set_gAMA(png, info, spec.gamma);
    if (!spec.icc.empty()) {
        png_set_iCCP(png, info, "profile", PNG_COMPRESSION_TYPE_BASE,
                     reinterpret_cast<png_const_bytep>(spec.icc.data()),
                     png_uint_32(spec.icc.size()));
    }
    if (!spec.exif.empty()) {
        std::vector<std::byte> copy = spec.exif;
        png_set_eXIf_1(png, info, png_uint_32(copy.size()),
                       reinterpret_cast<png_bytep>(copy.data()));
    }
    png_write_info(png, info);
    if (spec.bits < 8) png_set_packing(png);
    if (spec.bits == 16) png_set_swap(png);
    const int channels = channel_count(spec.color_type);
    const std::size_t row_samples = std::size_t(spec.width) * std::size_t(channels);
    const std::size_t sample_bytes = spec.bits == 16 ? 2 : 1;
    std::vector<std::vector<std::uint8_t>> rows;
    std::vector<png_bytep> pointers;
    for (int y = 0; y < spec.height; ++y) {
        rows.emplace_back(row_samples * sample_bytes);
        for (std::size_t i = 0; i < row_samples; ++i) {
            const auto v = std::uint16_t(spec.sample(int(i) / channels, y, int(i) % channels));
            std::memcpy(rows.back().data() + i * sample_bytes, &v, sample_bytes);
        }
    }
    for (auto& row : rows) pointers.push_back(row.data());
    png_write_image(png, pointers.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return out;
}

std::vector<std::byte> make_jpeg(const Image<SrgbU8>& image, const JpegSpec& spec) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &data, &size);
    jpeg.image_width = JDIMENSION(image.width());
    jpeg.image_height = JDIMENSION(image.height());
    jpeg.input_components = spec.gray ? 1 : spec.cmyk ? 4 : 3;
    jpeg.in_color_space = spec.gray ? JCS_GRAYSCALE : spec.cmyk ? JCS_CMYK : JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, spec.quality, TRUE);
    for (int c = 0; c < jpeg.num_components; ++c) {  // 4:4:4, so that pixels stay comparable
        jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
    }
    if (spec.progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    if (!spec.exif.empty()) {
        std::string marker("Exif\0\0", 6);
        marker.append(reinterpret_cast<const char*>(spec.exif.data()), spec.exif.size());
        jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(marker.data()),
                          unsigned(marker.size()));
    }
    if (!spec.icc.empty()) {
        jpeg_write_icc_profile(&jpeg, reinterpret_cast<const JOCTET*>(spec.icc.data()),
                               unsigned(spec.icc.size()));
    }
    for (int y = 0; y < image.height(); ++y) {
        std::vector<JSAMPLE> row;
        for (int x = 0; x < image.width(); ++x) {
            const SrgbU8 c = image(x, y);
            row.push_back(c.r);
            if (spec.gray) continue;
            row.insert(row.end(), {c.g, c.b});
            if (spec.cmyk) row.push_back(255);
        }
        JSAMPROW pointer = row.data();
        jpeg_write_scanlines(&jpeg, &pointer, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    auto bytes = bytes_of(data, size);
    std::free(data);
    return bytes;
}

void make_tiff(const std::filesystem::path& path, const std::function<void(TIFF*)>& fill,
               const char* mode) {
    TIFFSetWarningHandler(nullptr);
    TIFF* tiff = TIFFOpen(path.c_str(), mode);
    if (!tiff) throw std::runtime_error("libtiff cannot write");
    fill(tiff);
    TIFFClose(tiff);
}

void set_tiff_size(TIFF* tiff, int width, int height, int bits, int samples, int photometric) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, std::uint32_t(width));
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, std::uint32_t(height));
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
}

// Two directories behind the 8-byte TIFF header, then the values that do not fit into an entry.
std::vector<std::byte> make_exif(const ExifSpec& spec) {
    std::string out, values;
    const auto number = [&](std::string& to, std::uint32_t v, int size) {
        for (int i = 0; i < size; ++i) {
            to += char(v >> 8 * (spec.big_endian ? size - 1 - i : i) & 0xff);
        }
    };
    constexpr unsigned kCounts[] = {4, 7};
    constexpr unsigned kFirst = 8, kSecond = kFirst + 2 + 12 * kCounts[0] + 4;
    constexpr unsigned kValues = kSecond + 2 + 12 * kCounts[1] + 4;
    const auto start = [&](unsigned tag, unsigned type, unsigned count) {
        number(out, tag, 2), number(out, type, 2), number(out, count, 4);
    };
    const auto text = [&](unsigned tag, std::string v) {
        v += '\0';
        start(tag, 2, unsigned(v.size()));
        if (v.size() <= 4) {
            v.resize(4);
            out += v;
        } else {
            number(out, kValues + unsigned(values.size()), 4);
            values += v;
        }
    };
    const auto short_number = [&](unsigned tag, int v) {
        start(tag, 3, 1), number(out, std::uint32_t(v), 2), number(out, 0, 2);
    };
    const auto ratio = [&](unsigned tag, unsigned a, unsigned b) {
        start(tag, 5, 1), number(out, kValues + unsigned(values.size()), 4);
        number(values, a, 4), number(values, b, 4);
    };
    out = spec.big_endian ? "MM" : "II";
    number(out, 42, 2), number(out, kFirst, 4);
    number(out, kCounts[0], 2);
    text(0x010f, "Canon");
    text(0x0110, "Canon EOS R5");
    short_number(0x0112, spec.orientation);
    start(0x8769, 4, 1), number(out, kSecond, 4);
    number(out, 0, 4);
    number(out, kCounts[1], 2);
    ratio(0x829a, 1, 125);
    ratio(0x829d, 56, 10);
    short_number(0x8827, 100);
    text(0x9003, spec.date);
    text(0x9011, spec.offset);
    text(0x9291, spec.subseconds);
    short_number(0xa001, spec.color_space);
    number(out, 0, 4);
    out += values;
    return bytes_of(out.data(), out.size());
}

std::vector<std::byte> make_icc_p3() {
    const cmsCIExyY white{0.3127, 0.3290, 1};
    const cmsCIExyYTRIPLE primaries{{0.680, 0.320, 1}, {0.265, 0.690, 1}, {0.150, 0.060, 1}};
    const cmsFloat64Number curve[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
    cmsToneCurve* tone = cmsBuildParametricToneCurve(nullptr, 4, curve);
    cmsToneCurve* const tones[] = {tone, tone, tone};
    cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, tones);
    cmsFreeToneCurve(tone);
    name_profile(profile, "Display P3");
    return saved(profile);
}

std::vector<std::byte> make_icc_srgb() {
    cmsHPROFILE profile = cmsCreate_sRGBProfile();
    name_profile(profile, "sRGB test");
    return saved(profile);
}

std::vector<std::byte> make_icc_linear_gray() {
    cmsToneCurve* tone = cmsBuildGamma(nullptr, 1.0);
    cmsHPROFILE profile = cmsCreateGrayProfile(cmsD50_xyY(), tone);
    cmsFreeToneCurve(tone);
    name_profile(profile, "linear gray");
    return saved(profile);
}

}  // namespace verdigris
