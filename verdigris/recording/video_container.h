// SPDX-License-Identifier: MIT
// A video file opened for reading packets, or one sentence why not. Internal (FFmpeg types).
#pragma once

#include <filesystem>

#include "verdigris/recording/libav.h"

namespace verdigris {

struct VideoContainer {
    libav::FormatPtr format;
    AVStream* stream = nullptr;  ///< the video stream; packets of the others are discarded

    const AVCodecParameters& codec() const { return *stream->codecpar; }
};

/// Opens `path` and finds its video stream. Only demuxers of real video files are admitted (no
/// playlists that name other files, no pictures, no text) and nothing but files is opened.
/// Throws Error{bad_input}: not a video, no index (moov), no picture, encrypted, too large.
VideoContainer open_container(const std::filesystem::path& path);

/// A decoder for `container`. `threads` 0: all cores. A strict decoder reports a damaged frame as
/// an error; one that is not strict fills holes from other frames.
/// Throws Error{bad_input}: no decoder for it.
libav::CodecPtr open_decoder(const VideoContainer& container, int threads, bool strict,
                             const std::filesystem::path& path);

}  // namespace verdigris
