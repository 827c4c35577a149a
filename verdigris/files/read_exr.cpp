// SPDX-License-Identifier: MIT
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "verdigris/files/chromaticities.h"
#include "verdigris/files/decoders.h"
#include "verdigris/files/exr_threads.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 64;  // chosen: ~100 us of work at 4000 pixels a row

class Stream : public Imf::IStream {
  public:
    explicit Stream(InputFile& file) : Imf::IStream("picture"), file_(file) {}
    bool read(char to[], int count) override {
        if (count < 0 ||
            std::fread(to, 1, std::size_t(count), file_.handle()) < std::size_t(count)) {
            ended = true;
            throw std::runtime_error("the file ends early");
        }
        return true;
    }
    std::uint64_t tellg() override { return std::uint64_t(::ftello(file_.handle())); }
    void seekg(std::uint64_t position) override {
        if (position > file_.size()) {
            ended = true;
            throw std::runtime_error("the file ends early");
        }
        file_.seek(position);
    }
    void clear() override { std::clearerr(file_.handle()); }

    bool ended = false;

  private:
    InputFile& file_;
};

struct Window {
    std::int64_t x = 0, y = 0, width = 0, height = 0;
    explicit Window(const Imath::Box2i& box)
        : x(box.min.x),
          y(box.min.y),
          width(std::int64_t(box.max.x) - box.min.x + 1),
          height(std::int64_t(box.max.y) - box.min.y + 1) {}
    bool operator==(const Window&) const = default;
};

struct Channels {
    bool gray = false, extra = false;
    Imf::PixelType widest = Imf::HALF;
};

Channels find_channels(const InputFile& file, const Imf::ChannelList& list) {
    Channels found;
    const auto use = [&](const char* name) {
        const Imf::Channel* channel = list.findChannel(name);
        if (!channel) return false;
        if (channel->xSampling != 1 || channel->ySampling != 1) {
            file.refuse("is an OpenEXR with subsampled channels, which are not read");
        }
        if (channel->type != Imf::HALF) found.widest = channel->type;
        return true;
    };
    int used = 0;
    for (const char* name : {"R", "G", "B"}) used += use(name);
    if (used == 0) {
        if (!use("Y")) file.refuse("is an OpenEXR without channels R, G, B or Y");
        if (list.findChannel("RY") || list.findChannel("BY")) {
            file.refuse("is an OpenEXR in luminance and chroma (Y, RY, BY); save it as RGB");
        }
        found.gray = true;
        used = 1;
    } else if (used != 3) {
        file.refuse("is an OpenEXR without all of the channels R, G and B");
    }
    int all = 0;
    for (auto channel = list.begin(); channel != list.end(); ++channel) ++all;
    found.extra = all > used;
    return found;
}

Image<LinearF> read_samples(Stream& stream, const InputFile& file, const Window& data, bool gray) {
    exr_use_all_cores();
    Imf::InputFile exr(stream);
    if (!exr.isComplete()) file.refuse("is truncated: the OpenEXR data end early");
    // Zero-filled: a channel that a hostile file hides must not show old memory.
    Image<LinearF> image(int(data.width), int(data.height));
    Imf::FrameBuffer buffer;
    const auto add = [&](const char* name, float LinearF::*channel) {
        buffer.insert(
            name, Imf::Slice::Make(Imf::FLOAT, &(image.row(0)->*channel), exr.header().dataWindow(),
                                   sizeof(LinearF), sizeof(LinearF) * std::size_t(image.width())));
    };
    if (gray) {
        add("Y", &LinearF::r);
    } else {
        add("R", &LinearF::r);
        add("G", &LinearF::g);
        add("B", &LinearF::b);
    }
    exr.setFrameBuffer(buffer);
    exr.readPixels(exr.header().dataWindow().min.y, exr.header().dataWindow().max.y);
    return image;
}

// The display window is the picture; what the data window does not cover is black.
Image<LinearF> shown(Image<LinearF> image, const Window& data, const Window& display) {
    if (data == display) return image;
    Image<LinearF> out(int(display.width), int(display.height));
    const std::int64_t x0 = std::max(data.x, display.x);
    const std::int64_t x1 = std::min(data.x + data.width, display.x + display.width);
    const std::int64_t y0 = std::max(data.y, display.y);
    const std::int64_t y1 = std::min(data.y + data.height, display.y + display.height);
    for (std::int64_t y = y0; y < y1 && x0 < x1; ++y) {
        std::copy_n(image.row(int(y - data.y)) + (x0 - data.x), x1 - x0,
                    out.row(int(y - display.y)) + (x0 - display.x));
    }
    return out;
}

// Replicates gray, moves to sRGB primaries, and returns the first pixel that is no number.
std::optional<std::pair<int, int>> finish(Image<LinearF>& image, bool gray, const Matrix3* matrix) {
    using Found = std::optional<std::pair<int, int>>;
    const auto partials = map_rows<Found>(image.height(), kRowsPerRun, [&](RowRun run) {
        Found first;
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < image.width(); ++x) {
                LinearF& c = image(x, y);
                if (gray) c.g = c.b = c.r;
                const bool finite = std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
                if (!finite && !first) first = {x, y};
                if (matrix) c = multiply(*matrix, c);
            }
        }
        return first;
    });
    for (const Found& found : partials) {
        if (found) return found;
    }
    return std::nullopt;
}

void read_facts(const Imf::Header& header, ExifFacts& facts) {
    if (Imf::hasCapDate(header)) facts.date = Imf::capDate(header);
    if (Imf::hasUtcOffset(header) && std::abs(Imf::utcOffset(header)) < 86400) {
        // OpenEXR stores UTC minus local time; EXIF writes local minus UTC.
        const int minutes = int(std::lround(-Imf::utcOffset(header) / 60));
        facts.offset = fmt::format("{}{:02}:{:02}", minutes < 0 ? '-' : '+', std::abs(minutes) / 60,
                                   std::abs(minutes) % 60);
    }
    if (Imf::hasExpTime(header)) facts.exposure_seconds = double(Imf::expTime(header));
    if (Imf::hasAperture(header)) facts.f_number = double(Imf::aperture(header));
    if (Imf::hasIsoSpeed(header)) {
        const float iso = Imf::isoSpeed(header);
        if (iso > 0 && iso < 1e7f) facts.iso = int(std::lround(iso));
    }
}

Chromaticities from_attribute(const Imf::Chromaticities& c) {
    return {
        {c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
}

Decoded decode(InputFile& file, Stream& stream, Want want) {
    // The header alone first: InputFile allocates tables for every line before one could look.
    char start[8] = {};
    stream.read(start, sizeof(start));
    const int version = int(std::uint8_t(start[4])) | int(std::uint8_t(start[5])) << 8 |
                        int(std::uint8_t(start[6])) << 16 | int(std::uint8_t(start[7])) << 24;
    if (Imf::isNonImage(version)) file.refuse("is a deep OpenEXR, which is not read");
    Imf::Header header;
    int version_for_header = version;
    header.readFrom(stream, version_for_header);

    const Window data(header.dataWindow()), display(header.displayWindow());
    check_extent(file, data.width, data.height);
    check_extent(file, display.width, display.height);
    const Channels channels = find_channels(file, header.channels());

    Decoded out;
    out.info.format = "exr";
    out.info.width = int(display.width);
    out.info.height = int(display.height);
    out.info.bits = channels.widest == Imf::HALF ? 16 : 32;
    out.info.is_float = true;
    out.info.color = "linear (EXR)";
    out.gray = channels.gray;
    read_facts(header, out.exif);
    std::optional<Matrix3> matrix;
    if (Imf::hasChromaticities(header) && !channels.gray) {
        const Chromaticities from = from_attribute(Imf::chromaticities(header));
        const std::string name = chromaticities_name(from);
        if (!is_usable(from)) {
            out.notes.push_back({"chromaticities_ignored", Severity::caution,
                                 "the chromaticities make no color space; sRGB primaries are "
                                 "assumed"});
        } else if (!is_srgb_primaries(from)) {
            out.info.color = "EXR chromaticities: " + name;
            matrix = linear_from_chromaticities(from);
            out.notes.push_back({"primaries_converted", Severity::info,
                                 "converted to sRGB primaries from " + name});
        }
    }
    if (Imf::isMultiPart(version)) {
        out.notes.push_back(
            {"first_page", Severity::info, "holds several pictures; the first is read"});
    }
    if (channels.extra) {
        out.notes.push_back({"alpha_dropped", Severity::info,
                             "channels beside the colors (alpha, depth) are ignored"});
    }
    if (want == Want::header) return out;

    stream.seekg(0);
    auto image = shown(read_samples(stream, file, data, channels.gray), data, display);
    if (const auto bad = finish(image, channels.gray, matrix ? &*matrix : nullptr)) {
        file.refuse(
            fmt::format("holds NaN or infinity at pixel x = {}, y = {}", bad->first, bad->second));
    }
    out.pixels = std::move(image);
    return out;
}

}  // namespace

Decoded decode_exr(InputFile& file, Want want) {
    Stream stream(file);
    try {
        return decode(file, stream, want);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        if (stream.ended) file.refuse("is truncated: the OpenEXR data end early");
        file.refuse("is not a valid OpenEXR: " + std::string(error.what()));
    }
}

}  // namespace verdigris
