// SPDX-License-Identifier: MIT
#include "verdigris/recording/photo_reader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: 256 MiB of frames waiting, at least one; enough for all cores at 24 megapixels.
constexpr std::int64_t kAheadBytes = std::int64_t(256) << 20;

int sample_bytes(SampleType type) {
    return type == SampleType::u8 ? 1 : type == SampleType::u16 ? 2 : 4;
}

float clipped(float v) {
    return v > 0 ? std::min(v, 1.0f) : 0.0f;
}

// Encoded sRGB of any type -> another. 257 = 65535 / 255 is exact.
SrgbF encoded(SrgbU8 p) {
    return srgb_from_u8(p);
}
SrgbF encoded(SrgbU16 p) {
    return srgb_from_u16(p);
}
// Linear light of an EXR; what is brighter than white clips as it does in every other camera file.
SrgbF encoded(LinearF p) {
    return srgb_from_linear(LinearF{clipped(p.r), clipped(p.g), clipped(p.b)});
}
void convert(SrgbU8 p, SrgbU16& out) {
    out = {std::uint16_t(p.r * 257), std::uint16_t(p.g * 257), std::uint16_t(p.b * 257)};
}
template <class P>
void convert(P p, SrgbU8& out) {
    out = u8_from_srgb(encoded(p));
}
template <class P>
void convert(P p, SrgbU16& out) {
    out = u16_from_srgb(encoded(p));
}
template <class P>
void convert(P p, SrgbF& out) {
    out = encoded(p);
}

template <class To>
std::shared_ptr<const Image<To>> as(decltype(ImageFile::pixels) pixels) {
    auto out = std::make_shared<Image<To>>();
    std::visit(
        [&](auto& image) {
            if constexpr (std::is_same_v<std::decay_t<decltype(image)>, Image<To>>) {
                *out = std::move(image);
            } else {
                *out = Image<To>::for_overwrite(image.width(), image.height());
                for (std::size_t i = 0; i < image.pixel_count(); ++i) {
                    convert(image.pixels()[i], out->pixels()[i]);
                }
            }
        },
        pixels);
    return out;
}

template <class To>
void hand_on(decltype(ImageFile::pixels) pixels, SampleType type, Frame& frame) {
    const auto image = as<To>(std::move(pixels));
    frame.planes.count = 1;
    frame.planes.plane[0] = {reinterpret_cast<const std::byte*>(image->row(0)),
                             std::ptrdiff_t(std::size_t(image->width()) * sizeof(To)),
                             image->width(),
                             image->height(),
                             3,
                             type};
    frame.owner = image;
}

}  // namespace

PhotoReader::Decoded PhotoReader::decode(int index) const {
    const std::filesystem::path& path = photos_->files[std::size_t(index)];
    const FrameFormat& format = photos_->format;
    Decoded out;
    out.index = index;
    try {
        ImageFile file;
        try {
            file = read_image(path);
        } catch (const Error& error) {
            // Values that are no numbers are not damage: the file says what it means to say.
            if (error.sentence().find("NaN") != std::string::npos) throw;
            if (error.code() != ErrorCode::bad_input) throw;
            out.broken = path.filename().string() + " cannot be read: " + error.sentence();
            return out;
        }
        if (file.info.width != format.coded_width || file.info.height != format.coded_height) {
            throw Error(ErrorCode::bad_input,
                        "is " + std::to_string(file.info.width) + " x " +
                            std::to_string(file.info.height) + " pixels, but the recording is " +
                            std::to_string(format.coded_width) + " x " +
                            std::to_string(format.coded_height),
                        path.string());
        }
        out.frame.index = index;
        out.frame.seconds = photos_->times[std::size_t(index)];
        switch (format.type) {
            case SampleType::u8:
                hand_on<SrgbU8>(std::move(file.pixels), format.type, out.frame);
                break;
            case SampleType::u16:
                hand_on<SrgbU16>(std::move(file.pixels), format.type, out.frame);
                break;
            case SampleType::f32:
                hand_on<SrgbF>(std::move(file.pixels), format.type, out.frame);
                break;
        }
    } catch (...) {
        out.failure = std::current_exception();
    }
    return out;
}

void PhotoReader::read_ahead() {
    const FrameFormat& format = photos_->format;
    const std::int64_t bytes =
        std::int64_t(format.coded_width) * format.coded_height * 3 * sample_bytes(format.type);
    const int cores = std::max(int(std::thread::hardware_concurrency()), 1);
    const int wanted = 2 * (photos_->threads > 0 ? photos_->threads : cores);
    const int most =
        photos_->threads == 1 ? 1 : int(std::clamp<std::int64_t>(kAheadBytes / bytes, 1, wanted));
    const int count = std::min({depth_, most, int(photos_->files.size()) - position_});
    depth_ = std::min(2 * depth_, most);
    std::vector<Decoded> batch(std::size_t(std::max(count, 0)));
    parallel_for(count, [&](int i) { batch[std::size_t(i)] = decode(position_ + i); });
    for (Decoded& decoded : batch) ahead_.push_back(std::move(decoded));
}

bool PhotoReader::next(Frame& frame) {
    while (position_ < int(photos_->files.size())) {
        if (ahead_.empty()) read_ahead();
        Decoded decoded = std::move(ahead_.front());
        ahead_.pop_front();
        ++position_;
        if (decoded.failure) std::rethrow_exception(decoded.failure);
        if (decoded.broken.empty()) {
            ++report_.decoded;
            frame = std::move(decoded.frame);
            return true;
        }
        if (report_.lost++ == 0) {
            report_.first_lost = decoded.index;
            report_.reason = decoded.broken;
        }
    }
    return false;
}

void PhotoReader::seek(int index) {
    index = std::clamp(index, 0, int(photos_->files.size()));
    const int step = index - position_;
    if (step >= 0 && step < int(ahead_.size())) {
        ahead_.erase(ahead_.begin(), ahead_.begin() + step);
    } else {
        ahead_.clear();
        depth_ = 1;
    }
    position_ = index;
}

}  // namespace verdigris
