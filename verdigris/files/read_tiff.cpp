// SPDX-License-Identifier: MIT
#include <tiffio.h>

#include <array>
#include <cstdarg>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <vector>

#include "verdigris/files/decoders.h"

namespace verdigris {
namespace {

// chosen: a whole picture of kMaxImagePixels at 16 bit RGB in one strip, and some.
constexpr tmsize_t kMaxAllocation = tmsize_t(1) << 32;

// libtiff returns error codes; its messages go to the handlers of this one file.
struct Reader {
    InputFile& file;
    std::string message;
    bool ended = false;  // the file ended where libtiff wanted more
    TIFF* tiff = nullptr;

    explicit Reader(InputFile& f) : file(f) {
        const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
            TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
        TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMaxAllocation);
        TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, this);
        TIFFOpenOptionsSetWarningHandlerExtR(
            options.get(), [](TIFF*, void*, const char*, const char*, va_list) { return 1; },
            nullptr);
        // "m": no memory map; a file that shrinks meanwhile must not kill the process.
        tiff = TIFFClientOpenExt("", "rm", this, on_read, on_write, on_seek, on_close, on_size,
                                 nullptr, nullptr, options.get());
        if (!tiff) fail();
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() {
        if (tiff) TIFFClose(tiff);
    }

    static int on_error(TIFF*, void* user, const char*, const char* format, va_list arguments) {
        auto* self = static_cast<Reader*>(user);
        std::array<char, 200> text{};
        std::vsnprintf(text.data(), text.size(), format, arguments);
        if (self->message.empty()) self->message = text.data();
        return 1;
    }
    static tmsize_t on_read(thandle_t user, void* to, tmsize_t size) {
        auto* self = static_cast<Reader*>(user);
        const std::size_t got = std::fread(to, 1, std::size_t(size), self->file.handle());
        self->ended |= got < std::size_t(size);
        return tmsize_t(got);
    }
    static tmsize_t on_write(thandle_t, void*, tmsize_t) { return -1; }
    static toff_t on_seek(thandle_t user, toff_t offset, int whence) {
        auto* self = static_cast<Reader*>(user);
        // A directory or strip that is said to lie behind the end of the file.
        if (whence == SEEK_SET && offset > self->file.size()) self->ended = true;
        if (::fseeko(self->file.handle(), off_t(offset), whence) != 0) return toff_t(-1);
        return toff_t(::ftello(self->file.handle()));
    }
    static int on_close(thandle_t) { return 0; }
    static toff_t on_size(thandle_t user) { return static_cast<Reader*>(user)->file.size(); }

    [[noreturn]] void fail() const {
        if (ended) file.refuse("is truncated: the TIFF data end early");
        file.refuse("is not a valid TIFF: " + (message.empty() ? "unknown damage" : message));
    }

    template <class T>
    T number(ttag_t tag, T otherwise) const {
        T value = otherwise;
        return TIFFGetFieldDefaulted(tiff, tag, &value) ? value : otherwise;
    }
    // libtiff hands rationals out as float or double, depending on its version.
    double ratio(ttag_t tag) const {
        const TIFFField* field = TIFFFieldWithTag(tiff, tag);
        if (!field) return 0;
        float single = 0;
        double value = 0;
        if (TIFFFieldSetGetSize(field) == int(sizeof(double))) {
            return TIFFGetField(tiff, tag, &value) ? value : 0;
        }
        return TIFFGetField(tiff, tag, &single) ? double(single) : 0;
    }
    std::string text(ttag_t tag) const {
        const char* value = nullptr;
        return TIFFGetField(tiff, tag, &value) && value ? value : "";
    }
};

struct Header {
    std::uint32_t width = 0, height = 0;
    std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT, photometric = 0,
                  planar = PLANARCONFIG_CONTIG, compression = COMPRESSION_NONE;
    // Read sample by sample; otherwise libtiff's own conversion to 8-bit RGB does it.
    bool direct = false;
    bool gray() const {
        return photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE;
    }
    int colors() const { return gray() ? 1 : 3; }
};

void check_kind(const Reader& reader, const Header& h) {
    const InputFile& file = reader.file;
    // The first directory of camera raw files is a thumbnail; the picture hides behind it.
    const bool reduced =
        reader.number<std::uint32_t>(TIFFTAG_SUBFILETYPE, 0) & std::uint32_t(FILETYPE_REDUCEDIMAGE);
    std::uint16_t count = 0;
    const void* children = nullptr;
    const bool has_children =
        TIFFGetField(reader.tiff, TIFFTAG_SUBIFD, &count, &children) && count > 0;
    const std::uint8_t* version = nullptr;
    if (TIFFGetField(reader.tiff, TIFFTAG_DNGVERSION, &version) || (reduced && has_children) ||
        h.photometric == PHOTOMETRIC_CFA) {
        file.refuse("is a camera raw file; develop it to 16-bit TIFF");
    }
    if (h.format == SAMPLEFORMAT_IEEEFP) {
        file.refuse("is a TIFF with floating-point samples; save it as OpenEXR");
    }
    if (h.format != SAMPLEFORMAT_UINT && h.format != SAMPLEFORMAT_VOID) {
        file.refuse("is a TIFF with signed or complex samples, which are not read");
    }
    if (h.bits != 1 && h.bits != 2 && h.bits != 4 && h.bits != 8 && h.bits != 16) {
        file.refuse("is a TIFF with " + std::to_string(h.bits) +
                    " bits per sample; 8 and 16 are read");
    }
    if (h.photometric == PHOTOMETRIC_SEPARATED) {
        file.refuse("is a TIFF for print (CMYK); convert it to RGB");
    }
    const bool known = h.gray() || h.photometric == PHOTOMETRIC_RGB ||
                       h.photometric == PHOTOMETRIC_PALETTE || h.photometric == PHOTOMETRIC_YCBCR;
    if (!known) file.refuse("is a TIFF in a color space that is not read; convert it to RGB");
    if (h.bits == 16 && !h.direct) file.refuse("is a TIFF of a 16-bit kind that is not read");
    // chosen: three colors and a handful of masks; more is no picture from a camera.
    if (h.samples < 1 || h.samples > 16 || (h.direct && int(h.samples) < h.colors())) {
        file.refuse("is a TIFF with " + std::to_string(h.samples) + " samples per pixel");
    }
}

Header read_header(Reader& reader) {
    Header h;
    h.width = reader.number<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
    h.height = reader.number<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
    h.bits = reader.number<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
    h.samples = reader.number<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
    h.format = reader.number<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    h.planar = reader.number<std::uint16_t>(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    h.compression = reader.number<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    if (!TIFFGetField(reader.tiff, TIFFTAG_PHOTOMETRIC, &h.photometric)) {
        h.photometric = h.samples >= 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK;
    }
    check_extent(reader.file, h.width, h.height);
    if (h.photometric == PHOTOMETRIC_YCBCR && h.compression == COMPRESSION_JPEG &&
        h.planar == PLANARCONFIG_CONTIG) {
        // libjpeg converts, and upsamples the chroma, while it decodes.
        TIFFSetField(reader.tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
        h.photometric = PHOTOMETRIC_RGB;
    }
    h.direct = (h.bits == 8 || h.bits == 16) && (h.gray() || h.photometric == PHOTOMETRIC_RGB);
    check_kind(reader, h);
    return h;
}

// Puts `count` pixels of one row into place. `in` has `step` samples per pixel; `channel` is the
// first of them, and `channels` how many follow.
template <class P, class T>
void put_pixels(const Header& h, const T* in, int step, int channel, int channels, P* out,
                std::uint32_t count) {
    const T flip = h.photometric == PHOTOMETRIC_MINISWHITE ? T(~T(0)) : T(0);
    for (std::uint32_t x = 0; x < count; ++x, in += step) {
        if (h.gray()) {
            const T v = T(in[0] ^ flip);
            out[x] = {v, v, v};
            continue;
        }
        for (int c = channel; c < channel + channels; ++c) {
            // The analyzer does not see that check_extent() let no empty image through.
            // NOLINTNEXTLINE(clang-analyzer-core.NullDereference)
            (c == 0 ? out[x].r : c == 1 ? out[x].g : out[x].b) = in[c - channel];
        }
    }
}

template <class P>
Image<P> read_direct(const Reader& reader, const Header& h) {
    using T = decltype(P::r);
    const bool separate = h.planar == PLANARCONFIG_SEPARATE;
    const int planes = separate ? h.colors() : 1;
    const int step = separate ? 1 : int(h.samples);
    const int channels = separate ? 1 : h.colors();
    auto image = Image<P>::for_overwrite(int(h.width), int(h.height));
    const bool tiled = TIFFIsTiled(reader.tiff) != 0;
    std::uint32_t tile_width = h.width, tile_height = 1;
    if (tiled) {
        tile_width = reader.number<std::uint32_t>(TIFFTAG_TILEWIDTH, 0);
        tile_height = reader.number<std::uint32_t>(TIFFTAG_TILELENGTH, 0);
        check_extent(reader.file, tile_width, tile_height);
    }
    const auto expected = std::uint64_t(tile_width) * tile_height * sizeof(T) * unsigned(step);
    const auto size =
        std::uint64_t(tiled ? TIFFTileSize64(reader.tiff) : TIFFScanlineSize64(reader.tiff));
    // libtiff may count more than it needs (padding), never less.
    if (size < expected || size > std::uint64_t(kMaxAllocation)) reader.fail();
    std::vector<T> buffer(std::size_t(size / sizeof(T) + 1));
    for (int plane = 0; plane < planes; ++plane) {
        for (std::uint32_t y = 0; y < h.height; y += tile_height) {
            for (std::uint32_t x = 0; x < h.width; x += tile_width) {
                const bool read = tiled ? TIFFReadTile(reader.tiff, buffer.data(), x, y, 0,
                                                       std::uint16_t(plane)) >= 0
                                        : TIFFReadScanline(reader.tiff, buffer.data(), y,
                                                           std::uint16_t(plane)) >= 0;
                if (!read) reader.fail();
                const std::uint32_t columns = std::min(tile_width, h.width - x);
                const std::uint32_t rows = std::min(tile_height, h.height - y);
                for (std::uint32_t r = 0; r < rows; ++r) {
                    put_pixels(h, buffer.data() + std::size_t(r) * tile_width * unsigned(step),
                               step, plane, channels, image.row(int(y + r)) + x, columns);
                }
            }
        }
    }
    return image;
}

// Palettes, YCbCr without JPEG, 1, 2 and 4 bit.
Image<SrgbU8> read_converted(const Reader& reader, const Header& h) {
    std::array<char, 1024> why{};
    if (!TIFFRGBAImageOK(reader.tiff, why.data())) {
        reader.file.refuse("is a TIFF of a kind that is not read: " + std::string(why.data()));
    }
    auto packed = Image<std::uint32_t>::for_overwrite(int(h.width), int(h.height));
    // Asked for in the file's own orientation, libtiff turns nothing; read_image does.
    const int orientation = reader.number<std::uint16_t>(TIFFTAG_ORIENTATION, 1);
    if (!TIFFReadRGBAImageOriented(reader.tiff, h.width, h.height, packed.row(0), orientation, 1)) {
        reader.fail();
    }
    auto image = Image<SrgbU8>::for_overwrite(int(h.width), int(h.height));
    const auto from = packed.pixels();
    const auto to = image.pixels();
    for (std::size_t i = 0; i < from.size(); ++i) {
        to[i] = {std::uint8_t(TIFFGetR(from[i])), std::uint8_t(TIFFGetG(from[i])),
                 std::uint8_t(TIFFGetB(from[i]))};
    }
    return image;
}

ExifFacts read_facts(const Reader& reader) {
    ExifFacts facts;
    const int orientation = reader.number<std::uint16_t>(TIFFTAG_ORIENTATION, 1);
    if (orientation >= 1 && orientation <= 8) facts.orientation = orientation;
    facts.make = reader.text(TIFFTAG_MAKE);
    facts.model = reader.text(TIFFTAG_MODEL);
    toff_t offset = 0;
    if (!TIFFGetField(reader.tiff, TIFFTAG_EXIFIFD, &offset)) return facts;
    if (TIFFReadEXIFDirectory(reader.tiff, offset)) {
        facts.date = reader.text(EXIFTAG_DATETIMEORIGINAL);
        facts.subseconds = reader.text(EXIFTAG_SUBSECTIMEORIGINAL);
        facts.offset = reader.text(EXIFTAG_OFFSETTIMEORIGINAL);
        facts.exposure_seconds = reader.ratio(EXIFTAG_EXPOSURETIME);
        facts.f_number = reader.ratio(EXIFTAG_FNUMBER);
        std::uint16_t color_space = 0;
        if (TIFFGetField(reader.tiff, EXIFTAG_COLORSPACE, &color_space)) {
            facts.color_space = color_space;
        }
        std::uint16_t count = 0;
        const std::uint16_t* iso = nullptr;
        if (TIFFGetField(reader.tiff, EXIFTAG_ISOSPEEDRATINGS, &count, &iso) && count > 0 && iso) {
            facts.iso = iso[0];
        }
    }
    return facts;
}

}  // namespace

Decoded decode_tiff(InputFile& file, Want want) {
    Reader reader(file);
    Decoded out;
    out.exif = read_facts(reader);
    // A damaged EXIF part costs what it says, not the picture.
    reader.message.clear();
    reader.ended = false;
    if (!TIFFSetDirectory(reader.tiff, 0)) reader.fail();
    const Header h = read_header(reader);
    out.info.format = "tiff";
    out.info.width = int(h.width);
    out.info.height = int(h.height);
    out.info.bits = h.bits == 16 ? 16 : 8;
    out.gray = h.gray();
    std::uint32_t length = 0;
    const std::byte* profile = nullptr;
    if (TIFFGetField(reader.tiff, TIFFTAG_ICCPROFILE, &length, &profile) && profile) {
        out.icc.assign(profile, profile + length);
    }
    if (!TIFFLastDirectory(reader.tiff)) {
        out.notes.push_back(
            {"first_page", Severity::info, "holds several pictures; the first is read"});
    }
    if (int(h.samples) > h.colors() && h.photometric != PHOTOMETRIC_PALETTE &&
        h.photometric != PHOTOMETRIC_YCBCR) {
        out.notes.push_back({"alpha_dropped", Severity::info, "the alpha channel is ignored"});
    }
    if (want == Want::header) return out;
    if (!h.direct) {
        out.pixels = read_converted(reader, h);
    } else if (h.bits == 16) {
        out.pixels = read_direct<SrgbU16>(reader, h);
    } else {
        out.pixels = read_direct<SrgbU8>(reader, h);
    }
    return out;
}

}  // namespace verdigris
