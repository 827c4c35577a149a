// SPDX-License-Identifier: MIT
// A video file as a Recording. Internal.
#pragma once

#include <filesystem>

#include "verdigris/recording/recording.h"

namespace verdigris {

/// As open_recording, for a file.
Recording open_video(const std::filesystem::path& path, const RecordingOptions& options);

}  // namespace verdigris
