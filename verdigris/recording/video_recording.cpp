// SPDX-License-Identifier: MIT
#include "verdigris/recording/video_recording.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/sha256.h"
#include "verdigris/recording/hash_file.h"
#include "verdigris/recording/times_csv.h"
#include "verdigris/recording/video_reader.h"

namespace verdigris {
namespace {

class VideoSource : public Recording::Source {
  public:
    explicit VideoSource(std::shared_ptr<const VideoDescription> video)
        : video_(std::move(video)) {}
    std::unique_ptr<FrameReader> read() const override {
        return std::make_unique<VideoReader>(video_);
    }
    std::string sha256(const Progress& progress) const override {
        Sha256 hash;
        HashProgress done{progress, 0, std::int64_t(std::filesystem::file_size(video_->path))};
        hash_file(hash, video_->path, done);
        return hash.hex();
    }

  private:
    std::shared_ptr<const VideoDescription> video_;
};

// Phones write make and model under Apple's names, others under plain ones.
std::string camera_of(const AVFormatContext& format) {
    const auto value = [&](std::initializer_list<const char*> keys) -> std::string {
        for (const char* key : keys) {
            if (const AVDictionaryEntry* e = av_dict_get(format.metadata, key, nullptr, 0)) {
                return e->value;
            }
        }
        return {};
    };
    const std::string make =
        value({"com.apple.quicktime.make", "com.android.manufacturer", "make"});
    const std::string model = value({"com.apple.quicktime.model", "com.android.model", "model"});
    if (make.empty() || model.starts_with(make)) return model;
    return model.empty() ? make : make + " " + model;
}

// "mov,mp4,m4a,3gp,3g2,mj2" says no more than "mov,mp4".
std::string container_name(const AVFormatContext& format) {
    const std::string name = format.iformat->name;
    const std::size_t first = name.find(',');
    return name.substr(0, first == std::string::npos ? first : name.find(',', first + 1));
}

// How long the container says that the video is, in seconds; 0 if it does not. Matroska says it of
// the whole file only. What libav would guess from the bit rate is no promise.
double promised_seconds(const VideoContainer& container) {
    if (container.stream->duration != AV_NOPTS_VALUE)
        return double(container.stream->duration) * av_q2d(container.stream->time_base);
    const AVFormatContext& format = *container.format;
    const bool said = format.duration != AV_NOPTS_VALUE &&
                      format.duration_estimation_method == AVFMT_DURATION_FROM_STREAM;
    return said ? double(format.duration) / AV_TIME_BASE : 0;
}

// What the container announces and the file does not hold.
void note_broken_tail(const VideoContainer& container, const VideoIndex& index, Statuses& notes) {
    const std::int64_t here = std::int64_t(index.packets.size());
    const bool mp4 = std::string(container.format->iformat->name).starts_with("mov");
    std::string announced;
    if (mp4 && index.promised > here) {
        announced = std::to_string(index.promised) + " frames are announced, " +
                    std::to_string(here) + " are there";
    } else if (index.has_times) {
        const double promised = promised_seconds(container);
        // chosen: 5 % and 2 s; headers are written before the end is known, and round.
        if (promised - index.times.back() > std::max(2.0, 0.05 * promised)) {
            announced = std::to_string(std::lround(promised)) + " s are announced, " +
                        std::to_string(std::lround(index.times.back())) + " s are there";
        }
    }
    if (announced.empty() && index.packets.back().cut) announced = "its last frame is incomplete";
    if (announced.empty()) return;
    notes.push_back({"broken_tail", Severity::caution,
                     "the file seems to be cut off: " + announced + "; what is there is used"});
}

// The first whole frame. A decoder that finds fault with everything is asked to be lenient.
libav::FramePtr first_picture(const std::shared_ptr<VideoDescription>& video, Statuses& notes) {
    const int threads = std::exchange(video->threads, 1);
    std::string reason;
    for (const bool strict : {true, false}) {
        video->strict = strict;
        VideoReader reader(video);
        int index = 0;
        if (libav::FramePtr picture = reader.next_picture(index)) {
            video->threads = threads;
            if (!strict) {
                notes.push_back({"faulty_coding", Severity::caution,
                                 "every frame is coded with faults (" + reason +
                                     "); damaged frames cannot be told from whole ones"});
            }
            return picture;
        }
        reason = reader.report().reason;
    }
    throw Error(ErrorCode::bad_input,
                "none of its " + std::to_string(video->index.frame_count()) +
                    " frames can be decoded: " + reason,
                video->path.string());
}

bool is_there(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

// `clip.mp4.times.csv` is meant for this video and must fit; `times.csv` may belong to another.
bool read_sidecar(const std::filesystem::path& path, const VideoIndex& index, RecordingInfo& info) {
    const auto times_from = [&](const std::filesystem::path& csv) {
        const TimesCsv table(csv);
        std::vector<double> times = table.by_frame(
            index.frame_count(), int(std::min<std::int64_t>(index.promised, 1 << 30)));
        const int backward = backward_steps(times);
        if (backward > 0) {
            throw Error(ErrorCode::bad_input,
                        "its times run backwards in " + std::to_string(backward) +
                            " places, but the frames of a video have their order",
                        csv.string());
        }
        const double first = times.front();
        for (double& t : times) t -= first;
        return times;
    };
    std::filesystem::path own = path;
    own += ".times.csv";
    if (is_there(own)) {
        info.times = times_from(own);
        return true;
    }
    const std::filesystem::path shared = path.parent_path() / "times.csv";
    if (!is_there(shared)) return false;
    try {
        info.times = times_from(shared);
        return true;
    } catch (const Error& error) {
        info.notes.push_back(
            {"sidecar_ignored", Severity::caution,
             "times.csv beside the video does not fit it and is ignored: " + error.sentence()});
        return false;
    }
}

}  // namespace

Recording open_video(const std::filesystem::path& path, const RecordingOptions& options) {
    auto video = std::make_shared<VideoDescription>();
    video->path = path;
    video->threads = options.decode_threads;
    VideoContainer container = open_container(path);
    video->index = index_packets(container);
    const VideoIndex& index = video->index;
    if (index.frame_count() == 0) {
        throw Error(ErrorCode::bad_input, "its video stream is empty", path.string());
    }
    if (index.encrypted) refuse_encrypted(path);
    RecordingInfo info;
    info.path = path;
    info.kind = RecordingKind::video;
    video->first = first_picture(video, info.notes);
    video->color = read_video_format(*video->first, *container.stream, options, path);
    info.format = video->color.format;
    info.color_description = video->color.description;
    info.notes.insert(info.notes.end(), video->color.notes.begin(), video->color.notes.end());
    info.width = info.format.coded_width;
    info.height = info.format.coded_height;
    if (info.format.rotation % 180 != 0) std::swap(info.width, info.height);
    info.container = container_name(*container.format);
    info.codec = avcodec_get_name(container.codec().codec_id);
    info.camera = camera_of(*container.format);

    note_broken_tail(container, index, info.notes);
    info.times = index.times;
    info.time_source = index.has_times ? TimeSource::container : TimeSource::file_order;
    if (read_sidecar(path, index, info)) {
        info.time_source = TimeSource::sidecar;
    } else if (!index.has_times) {
        info.notes.push_back({"no_times", Severity::caution,
                              "the file has no time stamps; its frame rate is taken for them"});
    }
    video->index.times = info.times;
    info.variable_rate = has_variable_rate(
        info.times, info.time_source == TimeSource::container ? index.tick_seconds : 0);
    return Recording(std::move(info), std::make_shared<VideoSource>(std::move(video)));
}

}  // namespace verdigris
