// SPDX-License-Identifier: MIT
// A folder of photographs as a Recording. Internal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/recording/recording.h"

namespace verdigris {

/// As open_recording, for a folder.
Recording open_photographs(const std::filesystem::path& folder, const RecordingOptions& options);

}  // namespace verdigris
