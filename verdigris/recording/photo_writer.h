// SPDX-License-Identifier: MIT
// A folder of numbered PNGs with times.csv as a RecordingWriter. Internal.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "verdigris/recording/recording_writer.h"

namespace verdigris {

/// As write_recording, for a folder whose name and options have been checked.
std::unique_ptr<RecordingWriter> write_photographs(const std::filesystem::path& target,
                                                   const WriterOptions& options);

/// "000000.png": six digits, more where a recording is longer.
std::string picture_name(int index);

}  // namespace verdigris
