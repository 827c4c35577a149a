// SPDX-License-Identifier: MIT
// When the photographs of a folder were taken: times.csv, else EXIF, else their order. Internal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/files/image_file.h"
#include "verdigris/recording/recording.h"

namespace verdigris {

struct Photo {
    std::string name;    ///< in the folder
    ImageInfo info;      ///< as its header says
    std::string broken;  ///< why the header cannot be read, "" if it can
};

/// Fills `info.times`, `time_source` and `notes`, and puts `photos` into the order of the times.
/// `sidecar` is times.csv, or empty. With EXIF times, photographs without a readable header are
/// taken out: nobody knows when they were taken.
/// Throws Error{bad_input}: a table that does not fit; times that run against the order of the
/// names in more than half of the steps, which is a table or a clock gone wrong.
void time_photos(std::vector<Photo>& photos, const std::filesystem::path& sidecar,
                 RecordingInfo& info);

}  // namespace verdigris
