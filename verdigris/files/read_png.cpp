// SPDX-License-Identifier: MIT
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <variant>

#include "verdigris/files/decoders.h"
#include "verdigris/files/png.h"

namespace verdigris {
namespace {

// libpng reports errors by longjmp, which must not cross a C++ destructor. All that lives longer
// than a call into libpng is in this struct, outside of the guarded steps.
struct Reader {
    InputFile& file;
    png_structp png = nullptr;
    png_infop info = nullptr;
    char message[160] = "";
    bool ended = false;  // the file ended where libpng wanted more

    explicit Reader(InputFile& f) : file(f) {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        if (png) info = png_create_info_struct(png);
        if (!info) throw std::bad_alloc();
        png_set_read_fn(png, this, on_read);
        // The extent is checked against kMaxImagePixels before anything is allocated.
        png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }

    static void on_error(png_structp png, png_const_charp message) {
        auto* self = static_cast<Reader*>(png_get_error_ptr(png));
        std::strncpy(self->message, message, sizeof(self->message) - 1);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void on_read(png_structp png, png_bytep data, png_size_t size) {
        auto* self = static_cast<Reader*>(png_get_io_ptr(png));
        if (std::fread(data, 1, size, self->file.handle()) < size) {
            self->ended = true;
            png_error(png, "the file ends early");
        }
    }

    // `step` must own nothing: it may be left by longjmp.
    template <class Step>
    void guarded(Step step) {
        if (setjmp(png_jmpbuf(png)) == 0) {
            step();
            return;
        }
        if (ended) file.refuse("is truncated: the PNG data end early");
        file.refuse("is not a valid PNG: " + std::string(message));
    }
};

struct Header {
    png_uint_32 width = 0, height = 0;
    int bits = 0, color_type = 0, interlace = 0;
};

Header read_header(Reader& reader) {
    Header h;
    reader.guarded([&] {
        png_read_info(reader.png, reader.info);
        png_get_IHDR(reader.png, reader.info, &h.width, &h.height, &h.bits, &h.color_type,
                     &h.interlace, nullptr, nullptr);
    });
    check_extent(reader.file, h.width, h.height);
    return h;
}

// [PNG, 11.3.3]: iCCP, then sRGB, then gAMA and cHRM.
void read_color(Reader& reader, Decoded& out) {
    png_charp name = nullptr;
    png_bytep profile = nullptr;
    png_uint_32 length = 0;
    int method = 0, intent = 0;
    if (png_get_iCCP(reader.png, reader.info, &name, &method, &profile, &length)) {
        const auto* bytes = reinterpret_cast<const std::byte*>(profile);
        out.icc.assign(bytes, bytes + length);
        return;
    }
    if (png_get_sRGB(reader.png, reader.info, &intent)) {
        out.tagged_srgb = true;
        return;
    }
    double gamma = 0;
    if (!png_get_gAMA(reader.png, reader.info, &gamma)) return;
    // 1/2.2 is what writers put for sRGB. chosen: 5 % around it is no visible difference.
    if (std::abs(gamma * 2.2 - 1) > 0.05) {
        const bool linear = std::abs(gamma - 1) < 0.01;
        out.notes.push_back(
            {"gamma_ignored", Severity::caution,
             std::string(linear ? "says that its samples are linear light (gAMA 1.0)"
                                : "carries an unusual gamma (gAMA)") +
                 "; they are read as sRGB all the same: convert it, or remove the "
                 "gAMA chunk if it is wrong"});
    }
}

void read_exif_chunk(Reader& reader, Decoded& out) {
    png_bytep exif = nullptr;
    png_uint_32 length = 0;
    if (png_get_eXIf_1(reader.png, reader.info, &length, &exif)) {
        out.exif = read_exif({reinterpret_cast<const std::byte*>(exif), length});
    }
}

template <class P>
Image<P> read_rgb(Reader& reader, const Header& h) {
    auto image = Image<P>::for_overwrite(int(h.width), int(h.height));
    std::vector<png_bytep> rows(h.height);
    for (std::size_t y = 0; y < rows.size(); ++y) {
        rows[y] = reinterpret_cast<png_bytep>(image.row(int(y)));
    }
    png_bytepp row_pointers = rows.data();
    bool fits = true;
    reader.guarded([&] {
        png_structp png = reader.png;
        png_set_expand(png);
        if (!(h.color_type & PNG_COLOR_MASK_COLOR)) png_set_gray_to_rgb(png);
        png_set_strip_alpha(png);
        if (h.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
        png_set_interlace_handling(png);
        png_read_update_info(png, reader.info);
        fits = png_get_rowbytes(png, reader.info) == std::size_t(h.width) * sizeof(P);
        if (!fits) return;
        png_read_image(png, row_pointers);
        png_read_end(png, reader.info);
    });
    if (!fits) reader.file.refuse("is a PNG of a kind that is not read");
    return image;
}

}  // namespace

Decoded decode_png(InputFile& file, Want want) {
    Reader reader(file);
    const Header h = read_header(reader);
    Decoded out;
    out.info.format = "png";
    out.info.width = int(h.width);
    out.info.height = int(h.height);
    out.info.bits = h.bits == 16 ? 16 : 8;
    out.gray = !(h.color_type & PNG_COLOR_MASK_COLOR);
    read_color(reader, out);
    read_exif_chunk(reader, out);
    const bool alpha = (h.color_type & PNG_COLOR_MASK_ALPHA) ||
                       png_get_valid(reader.png, reader.info, PNG_INFO_tRNS);
    if (alpha) {
        out.notes.push_back({"alpha_dropped", Severity::info, "the alpha channel is ignored"});
    }
    if (want == Want::header) return out;
    if (h.bits == 16) {
        out.pixels = read_rgb<SrgbU16>(reader, h);
    } else {
        out.pixels = read_rgb<SrgbU8>(reader, h);
    }
    // An eXIf chunk may also follow the pixels.
    read_exif_chunk(reader, out);
    return out;
}

Image<std::uint8_t> read_gray_png(const std::filesystem::path& path) {
    InputFile file(path);
    if (file.size() == 0) file.refuse("is empty");
    png_byte signature[8] = {};
    const std::size_t got = file.read(std::as_writable_bytes(std::span(signature)));
    if (got < sizeof(signature) || png_sig_cmp(signature, 0, sizeof(signature)) != 0) {
        file.refuse("is not a PNG");
    }
    file.seek(0);
    Reader reader(file);
    const Header h = read_header(reader);
    if (h.bits != 8 || h.color_type != PNG_COLOR_TYPE_GRAY) {
        file.refuse("is not a single-channel 8-bit PNG");
    }
    auto image = Image<std::uint8_t>::for_overwrite(int(h.width), int(h.height));
    std::vector<png_bytep> rows(h.height);
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = image.row(int(y));
    png_bytepp row_pointers = rows.data();
    reader.guarded([&] {
        png_set_interlace_handling(reader.png);
        png_read_image(reader.png, row_pointers);
        png_read_end(reader.png, reader.info);
    });
    return image;
}

}  // namespace verdigris
