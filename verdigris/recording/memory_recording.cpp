// SPDX-License-Identifier: MIT
#include "verdigris/recording/memory_recording.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/sha256.h"
#include "verdigris/recording/times_csv.h"

namespace verdigris {
namespace {

struct MadeRecording {
    int width = 0, height = 0;
    std::vector<double> times;
    std::function<Image<SrgbU8>(int)> make;
    std::string name;

    Image<SrgbU8> frame(int index) const {
        Image<SrgbU8> image = make(index);
        if (!image.same_size(width, height)) {
            throw Error(ErrorCode::bad_input,
                        "is " + std::to_string(image.width()) + " x " +
                            std::to_string(image.height()) + " pixels, but the recording is " +
                            std::to_string(width) + " x " + std::to_string(height),
                        name + ", frame " + std::to_string(index));
        }
        return image;
    }
};

class MadeReader : public FrameReader {
  public:
    explicit MadeReader(std::shared_ptr<const MadeRecording> made) : made_(std::move(made)) {}

    bool next(Frame& frame) override {
        if (position_ >= int(made_->times.size())) return false;
        auto image = std::make_shared<const Image<SrgbU8>>(made_->frame(position_));
        frame.index = position_;
        frame.seconds = made_->times[std::size_t(position_)];
        frame.planes.count = 1;
        frame.planes.plane[0] = {reinterpret_cast<const std::byte*>(image->pixels().data()),
                                 std::ptrdiff_t(image->width()) * 3,
                                 image->width(),
                                 image->height(),
                                 3,
                                 SampleType::u8};
        frame.owner = std::move(image);
        ++position_;
        ++report_.decoded;
        return true;
    }
    void seek(int index) override { position_ = std::clamp(index, 0, int(made_->times.size())); }
    const DecodeReport& report() const override { return report_; }

  private:
    std::shared_ptr<const MadeRecording> made_;
    int position_ = 0;
    DecodeReport report_;
};

class MadeSource : public Recording::Source {
  public:
    explicit MadeSource(std::shared_ptr<const MadeRecording> made) : made_(std::move(made)) {}
    std::unique_ptr<FrameReader> read() const override {
        return std::make_unique<MadeReader>(made_);
    }
    std::string sha256(const Progress& progress) const override {
        Sha256 hash;
        const int count = int(made_->times.size());
        hash.update(std::to_string(made_->width) + "x" + std::to_string(made_->height));
        hash.update(std::as_bytes(std::span(made_->times)));
        for (int i = 0; i < count; ++i) {
            hash.update(std::as_bytes(std::as_const(*made_).frame(i).pixels()));
            verdigris::report(progress, "hash", i + 1, count);
        }
        return hash.hex();
    }

  private:
    std::shared_ptr<const MadeRecording> made_;
};

}  // namespace

Recording recording_from_function(int width, int height, std::vector<double> times,
                                  std::function<Image<SrgbU8>(int index)> frame, std::string name) {
    if (width <= 0 || height <= 0 || times.empty() || !frame) {
        throw Error(ErrorCode::usage, "a recording needs a size, times and frames", name);
    }
    if (backward_steps(times) > 0) {
        throw Error(ErrorCode::usage, "the times of a recording must not run backwards", name);
    }
    const double first = times.front();
    for (double& t : times) t -= first;
    RecordingInfo info;
    info.path = name;
    info.kind = RecordingKind::photographs;
    info.width = info.format.coded_width = width;
    info.height = info.format.coded_height = height;
    info.format.chroma_y = 0;
    info.times = times;
    info.time_source = TimeSource::sidecar;
    info.container = "memory";
    info.codec = "none";
    info.color_description = "sRGB";
    info.variable_rate = has_variable_rate(times, 0);
    auto made = std::make_shared<MadeRecording>(
        MadeRecording{width, height, std::move(times), std::move(frame), std::move(name)});
    return Recording(std::move(info), std::make_shared<MadeSource>(std::move(made)));
}

}  // namespace verdigris
