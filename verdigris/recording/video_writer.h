// SPDX-License-Identifier: MIT
// A video file as a RecordingWriter. Internal.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "verdigris/recording/libav.h"
#include "verdigris/recording/recording_writer.h"

namespace verdigris {

enum class VideoCoding { h264, ffv1 };

/// As write_recording, for a file whose name and options have been checked.
std::unique_ptr<RecordingWriter> write_video(const std::filesystem::path& target,
                                             const WriterOptions& options, VideoCoding coding);

/// FFmpeg's encoder `name`. Throws Error{failed} naming the target, with what to write `instead`,
/// where FFmpeg was built without it.
const AVCodec& find_encoder(const char* name, const std::string& instead,
                            const std::filesystem::path& target);

}  // namespace verdigris
