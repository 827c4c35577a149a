// SPDX-License-Identifier: MIT
#include "verdigris/recording/recording_writer.h"

#include "verdigris/recording/photo_writer.h"
#include "verdigris/recording/video_writer.h"
#include "verdigris/recording/writer_checks.h"

namespace verdigris {

std::unique_ptr<RecordingWriter> write_recording(const std::filesystem::path& target,
                                                 const WriterOptions& options) {
    const TargetKind kind = target_kind(target);
    check_options(target, options, kind);
    check_existing(target, options.replace, kind);
    if (kind == TargetKind::folder) return write_photographs(target, options);
    return write_video(target, options,
                       kind == TargetKind::mp4 ? VideoCoding::h264 : VideoCoding::ffv1);
}

}  // namespace verdigris
