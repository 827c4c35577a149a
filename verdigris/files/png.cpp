// SPDX-License-Identifier: MIT
// PNG as in [PNG]: signature, IHDR, color chunks, iTXt, IDAT, IEND.
#include "verdigris/files/png.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Bytes = std::vector<std::byte>;

// What the pixel type says about the file.
template <class P>
struct Layout;
template <class T, int kChannelCount, bool kIsColor>
struct LayoutOf {
    using Sample = T;
    static constexpr int kChannels = kChannelCount;
    static constexpr bool kColor = kIsColor;
};
template <>
struct Layout<SrgbU8> : LayoutOf<std::uint8_t, 3, true> {};
template <>
struct Layout<SrgbU16> : LayoutOf<std::uint16_t, 3, true> {};
template <>
struct Layout<Vec3U8> : LayoutOf<std::uint8_t, 3, false> {};
template <>
struct Layout<Vec3U16> : LayoutOf<std::uint16_t, 3, false> {};
template <>
struct Layout<std::uint8_t> : LayoutOf<std::uint8_t, 1, false> {};
template <>
struct Layout<std::uint16_t> : LayoutOf<std::uint16_t, 1, false> {};

// [PNG, 9.2] filter type "Up": the difference to the pixel above. chosen: smooth noise compresses
// within 1 % of the adaptive choice, and the loop is one subtraction per byte.
constexpr std::uint8_t kUpFilter = 2;
// Rows per task. chosen: 64 rows of a 4096-pixel map are ~0.8 MB, far above a task's overhead.
constexpr int kRowsPerRun = 64;
// A chunk holds at most 2^31 - 1 bytes [PNG, 5.3]; readers take any number of IDAT chunks.
constexpr std::size_t kMaxIdat = std::size_t(1) << 30;

void put_u32(Bytes& out, std::uint32_t v) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(std::byte(v >> shift & 0xff));
}

void put_chunk(Bytes& out, std::string_view type, std::span<const std::byte> data) {
    put_u32(out, std::uint32_t(data.size()));
    const std::size_t start = out.size();
    const auto name = std::as_bytes(std::span(type.data(), type.size()));
    out.insert(out.end(), name.begin(), name.end());
    out.insert(out.end(), data.begin(), data.end());
    put_u32(out, libdeflate_crc32(0, out.data() + start, out.size() - start));
}

void put_header(Bytes& out, int width, int height, int bits, int channels) {
    Bytes data;
    put_u32(data, std::uint32_t(width));
    put_u32(data, std::uint32_t(height));
    const int color_type = channels == 3 ? 2 : 0;
    for (const int v : {bits, color_type, 0, 0, 0}) data.push_back(std::byte(v));
    put_chunk(out, "IHDR", data);
}

// The values that [PNG, 11.3.3.5] asks to go with an sRGB chunk.
void put_color(Bytes& out) {
    put_chunk(out, "sRGB", std::array{std::byte{0}});  // perceptual: the usual intent of pictures
    Bytes gamma;
    put_u32(gamma, 45455);
    put_chunk(out, "gAMA", gamma);
    Bytes chromaticities;
    for (const std::uint32_t v : {31270u, 32900u, 64000u, 33000u, 30000u, 60000u, 15000u, 6000u}) {
        put_u32(chromaticities, v);
    }
    put_chunk(out, "cHRM", chromaticities);
}

// iTXt [PNG, 11.3.4.5]: keyword, 0, not compressed, method 0, no language, no translation, text.
void put_text(Bytes& out, const PngText& text) {
    const bool printable = std::all_of(text.keyword.begin(), text.keyword.end(),
                                       [](char c) { return c >= ' ' && c <= '~'; });
    if (text.keyword.empty() || text.keyword.size() > 79 || !printable ||
        text.keyword.front() == ' ' || text.keyword.back() == ' ' ||
        text.text.find('\0') != std::string::npos) {
        throw Error(ErrorCode::usage, "'" + text.keyword + "' cannot be the keyword of a PNG text");
    }
    const std::string data = text.keyword + std::string(5, '\0') + text.text;
    put_chunk(out, "iTXt", std::as_bytes(std::span(data.data(), data.size())));
}

// Samples as the file orders them: 16 bit big-endian.
void put_samples(const std::uint8_t* in, std::size_t count, std::uint8_t* out) {
    std::memcpy(out, in, count);
}
void put_samples(const std::uint16_t* in, std::size_t count, std::uint8_t* out) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint16_t v = in[i];
        const auto swapped =
            std::endian::native == std::endian::little ? std::uint16_t(v << 8 | v >> 8) : v;
        std::memcpy(out + 2 * i, &swapped, 2);  // the compiler makes one vector loop of it
    }
}

// Not a vector: filling a hundred megabytes with zeros first costs as much as filtering them.
struct Buffer {
    std::unique_ptr<std::uint8_t[]> data;
    std::size_t size = 0;
    explicit Buffer(std::size_t bytes)
        : data(std::make_unique_for_overwrite<std::uint8_t[]>(bytes)), size(bytes) {}
    std::span<const std::byte> bytes() const { return std::as_bytes(std::span(data.get(), size)); }
};

// The filtered picture, ready to be compressed: one filter byte and the samples of each row.
template <class P>
Buffer filtered(ImageView<const P> image) {
    using Sample = typename Layout<P>::Sample;
    const std::size_t samples = std::size_t(image.width()) * Layout<P>::kChannels;
    const std::size_t row_bytes = samples * sizeof(Sample);
    Buffer out((row_bytes + 1) * std::size_t(image.height()));
    parallel_rows(image.height(), kRowsPerRun, [&](RowRun run) {
        std::vector<std::uint8_t> above(row_bytes), row(row_bytes);
        const auto read = [&](int y, std::vector<std::uint8_t>& to) {
            put_samples(reinterpret_cast<const Sample*>(image.row(y)), samples, to.data());
        };
        if (run.begin > 0) read(run.begin - 1, above);
        for (int y = run.begin; y < run.end; ++y) {
            read(y, row);
            std::uint8_t* to = out.data.get() + std::size_t(y) * (row_bytes + 1);
            *to++ = kUpFilter;
            for (std::size_t i = 0; i < row_bytes; ++i) to[i] = std::uint8_t(row[i] - above[i]);
            std::swap(row, above);
        }
    });
    return out;
}

Buffer compressed(const Buffer& data, int level) {
    const auto release = [](libdeflate_compressor* c) { libdeflate_free_compressor(c); };
    const std::unique_ptr<libdeflate_compressor, decltype(release)> compressor(
        libdeflate_alloc_compressor(level), release);
    if (!compressor) {
        throw Error(ErrorCode::usage,
                    "PNG compression level " + std::to_string(level) + " is not in 1..12");
    }
    Buffer out(libdeflate_zlib_compress_bound(compressor.get(), data.size));
    out.size = libdeflate_zlib_compress(compressor.get(), data.data.get(), data.size,
                                        out.data.get(), out.size);
    return out;
}

template <class P>
Bytes encode(ImageView<const P> image, const PngOptions& options) {
    if (image.empty()) throw Error(ErrorCode::failed, "an empty picture cannot be a PNG");
    if (options.level < 1 || options.level > 12) {
        throw Error(ErrorCode::usage,
                    "PNG compression level " + std::to_string(options.level) + " is not in 1..12");
    }
    const Buffer data = compressed(filtered(image), options.level);

    Bytes out;
    out.reserve(data.size + 1024);
    // [PNG, 5.2]: the signature spells PNG between bytes that text transfers would damage.
    for (const int v : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a})
        out.push_back(std::byte(v));
    put_header(out, image.width(), image.height(), int(sizeof(typename Layout<P>::Sample)) * 8,
               Layout<P>::kChannels);
    if (Layout<P>::kColor) put_color(out);
    for (const PngText& text : options.text) put_text(out, text);
    for (std::size_t at = 0; at < data.size; at += kMaxIdat) {
        put_chunk(out, "IDAT", data.bytes().subspan(at, std::min(kMaxIdat, data.size - at)));
    }
    put_chunk(out, "IEND", {});
    return out;
}

}  // namespace

Bytes encode_png(ImageView<const SrgbU8> image, const PngOptions& options) {
    return encode(image, options);
}
Bytes encode_png(ImageView<const SrgbU16> image, const PngOptions& options) {
    return encode(image, options);
}
Bytes encode_png(ImageView<const Vec3U8> image, const PngOptions& options) {
    return encode(image, options);
}
Bytes encode_png(ImageView<const Vec3U16> image, const PngOptions& options) {
    return encode(image, options);
}
Bytes encode_png(ImageView<const std::uint8_t> image, const PngOptions& options) {
    return encode(image, options);
}
Bytes encode_png(ImageView<const std::uint16_t> image, const PngOptions& options) {
    return encode(image, options);
}

template <class P>
void write_png(const std::filesystem::path& path, ImageView<const P> image,
               const PngOptions& options) {
    Bytes bytes;
    try {
        bytes = encode_png(image, options);
    } catch (const Error& error) {
        throw Error(error.code(), error.sentence(), path.string());
    }
    write_file(path, bytes);
}
template void write_png(const std::filesystem::path&, ImageView<const SrgbU8>, const PngOptions&);
template void write_png(const std::filesystem::path&, ImageView<const SrgbU16>, const PngOptions&);
template void write_png(const std::filesystem::path&, ImageView<const Vec3U8>, const PngOptions&);
template void write_png(const std::filesystem::path&, ImageView<const Vec3U16>, const PngOptions&);
template void write_png(const std::filesystem::path&, ImageView<const std::uint8_t>,
                        const PngOptions&);
template void write_png(const std::filesystem::path&, ImageView<const std::uint16_t>,
                        const PngOptions&);

}  // namespace verdigris
