// SPDX-License-Identifier: MIT
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>
#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/exr_threads.h"
#include "verdigris/files/image_file.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 64;  // chosen: ~100 us of work at 4000 pixels a row

// OpenEXR seeks back to fill in its table of offsets, and swallows what is thrown while it does:
// the first error is kept.
class Stream : public Imf::OStream {
  public:
    explicit Stream(AtomicFile& file) : Imf::OStream("picture"), file_(file) {}
    void write(const char bytes[], int count) override {
        const auto data = std::as_bytes(std::span(bytes, std::size_t(count)));
        try {
            const std::size_t over = std::min<std::size_t>(data.size(), end_ - position_);
            if (over > 0) file_.rewrite(position_, data.first(over));
            if (over < data.size()) file_.write(data.subspan(over));
        } catch (...) {
            if (!failure_) failure_ = std::current_exception();
            throw;
        }
        position_ += data.size();
        end_ = std::max(end_, position_);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = std::size_t(position); }
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

  private:
    AtomicFile& file_;
    std::size_t position_ = 0, end_ = 0;
    std::exception_ptr failure_;
};

void write(const std::filesystem::path& path, const Imf::Header& header,
           const Imf::FrameBuffer& buffer) {
    exr_use_all_cores();
    AtomicFile file(path);
    Stream stream(file);
    try {
        Imf::OutputFile exr(stream, header);
        exr.setFrameBuffer(buffer);
        exr.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
    } catch (const std::exception& error) {
        stream.rethrow();
        throw Error(ErrorCode::failed, "cannot be written: " + std::string(error.what()),
                    path.string());
    }
    stream.rethrow();
    file.commit();
}

// EXR readers, ours included, stop at what is no number: refuse to make such a file.
[[noreturn]] void refuse_pixel(const std::filesystem::path& path, int y) {
    throw Error(ErrorCode::failed,
                fmt::format("is not written: the picture holds NaN or infinity in row {}", y),
                path.string());
}

void refuse_empty(const std::filesystem::path& path, bool empty) {
    if (empty) {
        throw Error(ErrorCode::failed, "an empty picture cannot be an OpenEXR", path.string());
    }
}

struct HalfRgb {
    half r, g, b;
};

half half_from_float(float v) {
    return half(std::clamp(v, -float(HALF_MAX), float(HALF_MAX)));
}

}  // namespace

void exr_use_all_cores() {
    static std::once_flag once;
    std::call_once(once, [] {
        if (Imf::globalThreadCount() == 0) {
            Imf::setGlobalThreadCount(int(std::thread::hardware_concurrency()));
        }
    });
}

void write_exr(const std::filesystem::path& path, ImageView<const LinearF> image) {
    refuse_empty(path, image.empty());
    auto pixels = Image<HalfRgb>::for_overwrite(image.width(), image.height());
    const auto bad_rows = map_rows<int>(image.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const LinearF& c = image(x, y);
                if (!std::isfinite(c.r) || !std::isfinite(c.g) || !std::isfinite(c.b)) return y;
                pixels(x, y) = {half_from_float(c.r), half_from_float(c.g), half_from_float(c.b)};
            }
        }
        return -1;
    });
    for (const int y : bad_rows) {
        if (y >= 0) refuse_pixel(path, y);
    }
    Imf::Header header(image.width(), image.height());
    header.compression() = Imf::PIZ_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec.709, as sRGB
    Imf::FrameBuffer buffer;
    const auto add = [&](const char* name, half HalfRgb::*channel) {
        header.channels().insert(name, Imf::Channel(Imf::HALF));
        buffer.insert(
            name, Imf::Slice::Make(Imf::HALF, &(pixels.row(0)->*channel), header.dataWindow(),
                                   sizeof(HalfRgb), sizeof(HalfRgb) * std::size_t(image.width())));
    };
    add("R", &HalfRgb::r);
    add("G", &HalfRgb::g);
    add("B", &HalfRgb::b);
    write(path, header, buffer);
}

void write_exr(const std::filesystem::path& path, ImageView<const float> image) {
    refuse_empty(path, image.empty());
    for (int y = 0; y < image.height(); ++y) {
        const float* row = image.row(y);
        if (!std::all_of(row, row + image.width(), [](float v) { return std::isfinite(v); })) {
            refuse_pixel(path, y);
        }
    }
    Imf::Header header(image.width(), image.height());
    // chosen: ZIP is the lossless one that every reader has, and suits float better than PIZ.
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::FrameBuffer buffer;
    buffer.insert("Y",
                  Imf::Slice::Make(Imf::FLOAT, image.row(0), header.dataWindow(), sizeof(float),
                                   sizeof(float) * std::size_t(image.stride())));
    write(path, header, buffer);
}

}  // namespace verdigris
