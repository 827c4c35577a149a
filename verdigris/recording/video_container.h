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

/// True for a packet under common encryption (CENC).
bool is_encrypted(const AVPacket& packet);
[[noreturn]] void refuse_encrypted(const std::filesystem::path& path);

/// How a decoder is opened.
enum class Decoding {
    fast,     ///< all threads; damage is an error where the decoder can be asked for that
    careful,  ///< one thread: an error belongs to the packet sent last, marks on frames are true
    lenient,  ///< all threads; holes are filled from other frames and nothing is said
};

/// A decoder for `container`. `threads` 0: all cores.
/// Throws Error{bad_input}: no decoder for it.
libav::CodecPtr open_decoder(const VideoContainer& container, Decoding how, int threads,
                             const std::filesystem::path& path);
/// True for codecs that only mark damaged frames and never give up on them: these are decoded
/// without frame threads, which lose the marks, and so carefully from the first.
bool only_marks_damage(const VideoContainer& container);

}  // namespace verdigris
