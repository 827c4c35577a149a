// SPDX-License-Identifier: MIT
#include <csetjmp>
#include <cstddef>
#include <cstdio>
// jpeglib.h needs FILE and size_t declared before it.
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "verdigris/files/decoders.h"

namespace verdigris {
namespace {

// chosen: progressive files have ~10 scans; an attack repeats tiny scans over a huge picture.
constexpr int kMaxScans = 500;

// libjpeg reports errors by a callback that must not return. All that lives longer than a call
// into libjpeg is in this struct, outside of the guarded steps.
struct Reader {
    InputFile& file;
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf jump{};
    char message[JMSG_LENGTH_MAX] = "";
    char damage[JMSG_LENGTH_MAX] = "";
    int code = 0;
    bool ended = false;  // the file ended where libjpeg wanted more

    explicit Reader(InputFile& f) : file(f) {
        jpeg.err = jpeg_std_error(&errors);
        jpeg.client_data = this;
        errors.error_exit = on_error;
        errors.emit_message = on_message;
        errors.output_message = [](j_common_ptr) {};
        progress.progress_monitor = on_progress;
        guarded([&] {
            jpeg_create_decompress(&jpeg);
            jpeg.progress = &progress;
            jpeg_stdio_src(&jpeg, file.handle());
        });
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { jpeg_destroy_decompress(&jpeg); }

    static Reader& of(j_common_ptr jpeg) { return *static_cast<Reader*>(jpeg->client_data); }
    static void on_error(j_common_ptr jpeg) {
        Reader& self = of(jpeg);
        self.code = jpeg->err->msg_code;
        jpeg->err->format_message(jpeg, self.message);
        std::longjmp(self.jump, 1);
    }
    static void on_message(j_common_ptr jpeg, int level) {
        if (level >= 0) return;  // trace messages
        Reader& self = of(jpeg);
        ++jpeg->err->num_warnings;
        if (jpeg->err->msg_code == JWRN_JPEG_EOF) {
            // libjpeg would fill the rest of the picture with gray.
            self.ended = true;
            std::longjmp(self.jump, 1);
        }
        if (self.damage[0] == '\0') jpeg->err->format_message(jpeg, self.damage);
    }
    static void on_progress(j_common_ptr jpeg) {
        if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > kMaxScans) {
            Reader& self = of(jpeg);
            std::strncpy(self.message, "too many scans", sizeof(self.message) - 1);
            std::longjmp(self.jump, 1);
        }
    }

    // `step` must own nothing: it may be left by longjmp.
    template <class Step>
    void guarded(Step step) {
        if (setjmp(jump) == 0) {
            step();
            return;
        }
        if (ended) file.refuse("is truncated: the JPEG data end early");
        if (code == JERR_BAD_PRECISION) {
            file.refuse("is a JPEG with " + std::to_string(jpeg.data_precision) +
                        " bits per sample, only 8 are read");
        }
        file.refuse("is not a valid JPEG: " + std::string(message));
    }
};

void read_markers(const Reader& reader, Decoded& out) {
    using namespace std::string_view_literals;
    constexpr auto kExif = "Exif\0\0"sv;
    for (auto* m = reader.jpeg.marker_list; m != nullptr; m = m->next) {
        const std::string_view data(reinterpret_cast<const char*>(m->data), m->data_length);
        if (m->marker == JPEG_APP0 + 1 && data.substr(0, kExif.size()) == kExif) {
            out.exif =
                read_exif(std::as_bytes(std::span(data.data(), data.size()).subspan(kExif.size())));
            return;
        }
    }
}

void read_icc(Reader& reader, Decoded& out) {
    JOCTET* profile = nullptr;
    unsigned length = 0;
    bool found = false;
    reader.guarded([&] { found = jpeg_read_icc_profile(&reader.jpeg, &profile, &length); });
    if (!found) return;
    const auto* bytes = reinterpret_cast<const std::byte*>(profile);
    out.icc.assign(bytes, bytes + length);
    std::free(profile);
}

Image<SrgbU8> read_rgb(Reader& reader) {
    jpeg_decompress_struct& jpeg = reader.jpeg;
    auto image = Image<SrgbU8>::for_overwrite(int(jpeg.image_width), int(jpeg.image_height));
    bool fits = true;
    reader.guarded([&] {
        jpeg.out_color_space = JCS_RGB;
        jpeg.dct_method = JDCT_ISLOW;  // the accurate one
        jpeg_start_decompress(&jpeg);
        fits = jpeg.output_components == 3 && int(jpeg.output_width) == image.width() &&
               int(jpeg.output_height) == image.height();
        while (fits && jpeg.output_scanline < jpeg.output_height) {
            JSAMPROW row = reinterpret_cast<JSAMPROW>(image.row(int(jpeg.output_scanline)));
            jpeg_read_scanlines(&jpeg, &row, 1);
        }
        if (fits) jpeg_finish_decompress(&jpeg);
    });
    if (!fits) reader.file.refuse("is a JPEG of a kind that is not read");
    return image;
}

}  // namespace

Decoded decode_jpeg(InputFile& file, Want want) {
    Reader reader(file);
    reader.guarded([&] {
        jpeg_save_markers(&reader.jpeg, JPEG_APP0 + 1, 0xffff);
        jpeg_save_markers(&reader.jpeg, JPEG_APP0 + 2, 0xffff);
        jpeg_read_header(&reader.jpeg, TRUE);
    });
    check_extent(file, reader.jpeg.image_width, reader.jpeg.image_height);
    const J_COLOR_SPACE space = reader.jpeg.jpeg_color_space;
    if (space == JCS_CMYK || space == JCS_YCCK) {
        file.refuse("is a JPEG for print (CMYK); convert it to RGB");
    }
    if (reader.jpeg.data_precision != 8) {
        file.refuse("is a JPEG with " + std::to_string(reader.jpeg.data_precision) +
                    " bits per sample, only 8 are read");
    }
    Decoded out;
    out.info.format = "jpeg";
    out.info.width = int(reader.jpeg.image_width);
    out.info.height = int(reader.jpeg.image_height);
    out.info.bits = 8;
    out.gray = space == JCS_GRAYSCALE;
    read_markers(reader, out);
    read_icc(reader, out);
    if (want == Want::header) return out;
    out.pixels = read_rgb(reader);
    if (reader.damage[0] != '\0') {
        out.notes.push_back(
            {"damaged", Severity::caution,
             "is damaged, a part of the picture may be wrong: " + std::string(reader.damage)});
    }
    return out;
}

}  // namespace verdigris
