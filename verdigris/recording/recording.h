// SPDX-License-Identifier: MIT
// A recording: a video or a folder of photographs from one fixed camera, as shot. Nothing is held:
// opening reads headers and time stamps, frames are decoded one after another.
// Path: files -> [recording] -> observe.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "verdigris/progress.h"
#include "verdigris/recording/frame_format.h"
#include "verdigris/status.h"

namespace verdigris {

enum class RecordingKind { video, photographs };
/// In order of trust.
enum class TimeSource { sidecar, exif, container, file_order };

/// All that is known before a frame is decoded.
struct RecordingInfo {
    std::filesystem::path path;
    RecordingKind kind{};
    int width = 0, height = 0;  ///< as shown: rotation and EXIF orientation applied
    FrameFormat format;         ///< of the decoded planes
    std::vector<double> times;  ///< seconds from the first frame, non-decreasing, one per frame
    TimeSource time_source{};
    std::string container, codec;   ///< "mov,mp4 / h264", "png", ...
    std::string color_description;  ///< "BT.709 limited range, 8 bit", "sRGB (assumed)", ...
    std::string camera;             ///< EXIF or container metadata, "" if unknown
    bool variable_rate = false;     ///< the steps between times differ by more than 1 %
    Statuses notes;                 ///< what was guessed, repaired or ignored
};

/// One decoded frame: planes that stay valid while `owner` lives. Rotation is NOT applied yet:
/// see srgb_from_planes in to_srgb.h.
struct Frame {
    int index = 0;       ///< into RecordingInfo::times
    double seconds = 0;  ///< RecordingInfo::times[index]
    PlaneSet planes;
    std::shared_ptr<const void> owner;
};

/// What was lost on the way. A broken tail costs the broken frames only.
struct DecodeReport {
    int decoded = 0;
    int lost = 0;         ///< expected from the time stamps, but not decodable
    int first_lost = -1;  ///< index of the first lost frame, -1 if none
    std::string reason;   ///< "the file ends in the middle of frame 41", "" if nothing was lost
};

/// Decodes frames in order.
class FrameReader {
  public:
    virtual ~FrameReader() = default;
    /// The next frame at or after the current position; false at the end. A frame that cannot be
    /// decoded is skipped and counted in report().
    /// Throws Error{bad_input} naming file and frame where going on would mix things up: a
    /// photograph of another size, NaN in an EXR.
    virtual bool next(Frame& frame) = 0;
    /// Moves so that the following next() gives frame `index` (or the first decodable one after
    /// it). Cheap forwards; in videos it may decode from the key frame before.
    virtual void seek(int index) = 0;
    virtual const DecodeReport& report() const = 0;
};

struct RecordingOptions {
    /// Assume these where the file does not say. Empty: BT.709 for HD, BT.601 below 720 lines.
    std::string assume_matrix, assume_range;
    int decode_threads = 0;  ///< 0: all cores
};

/// A handle; copies share the same description.
class Recording {
  public:
    /// Where frames come from; recordings made in memory (tests, the simulator) implement it.
    struct Source {
        virtual ~Source() = default;
        virtual std::unique_ptr<FrameReader> read() const = 0;
        /// SHA-256 of the input bytes (for a folder: of the names and contents in order).
        virtual std::string sha256(const Progress& progress) const = 0;
    };
    Recording(RecordingInfo info, std::shared_ptr<const Source> source)
        : info_(std::make_shared<RecordingInfo>(std::move(info))), source_(std::move(source)) {}

    const RecordingInfo& info() const { return *info_; }
    /// A fresh reader at frame 0. Readers are independent of each other.
    std::unique_ptr<FrameReader> read() const { return source_->read(); }
    std::string sha256(const Progress& progress = {}) const { return source_->sha256(progress); }

  private:
    std::shared_ptr<const RecordingInfo> info_;
    std::shared_ptr<const Source> source_;
};

/// A file is a video (or a single-picture recording, refused later for want of time); a folder is
/// a sequence of photographs, naturally sorted ("2.png" before "10.png"), all of one size.
/// Times: `times.csv` beside or inside (columns file or frame, and time), else EXIF, else the
/// container's time stamps, else the file order with a note.
/// Cost: reads headers; for a video one pass over the packets without decoding.
/// Throws Error{bad_input}: missing, empty folder, not a video, zero-length stream, mixed sizes.
Recording open_recording(const std::filesystem::path& path, const RecordingOptions& options = {});

}  // namespace verdigris
