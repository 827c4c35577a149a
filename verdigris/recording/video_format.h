// SPDX-License-Identifier: MIT
// What a video's pixel layout and color tags mean, and the guesses where tags are missing.
// Internal (FFmpeg types).
#pragma once

#include <filesystem>
#include <string>

#include "verdigris/recording/frame_format.h"
#include "verdigris/recording/libav.h"
#include "verdigris/recording/recording.h"
#include "verdigris/status.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace verdigris {

/// How the shown frame comes from the coded one: mirrored top to bottom first, then turned.
struct Turn {
    int rotation = 0;  ///< degrees clockwise: 0, 90, 180, 270
    bool mirrored = false;
};

struct VideoFormat {
    FrameFormat format;
    Turn turn;
    std::string description;  ///< RecordingInfo::color_description
    Statuses notes;
};

/// Reads the tags of the first decoded frame. Throws Error{bad_input} for a layout or a matrix we
/// do not read, Error{usage} for an assumption that is none of bt709, bt601, bt2020, limited, full.
VideoFormat read_video_format(const AVFrame& frame, const AVStream& stream,
                              const RecordingOptions& options, const std::filesystem::path& path);

/// The descriptor of a layout frame_planes can hand on, or null.
const AVPixFmtDescriptor* readable_layout(int pixel_format);

}  // namespace verdigris
