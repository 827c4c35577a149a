// SPDX-License-Identifier: MIT
#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/recording/photo_folder.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/video_recording.h"

namespace verdigris {

Recording open_recording(const std::filesystem::path& path, const RecordingOptions& options) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        throw Error(ErrorCode::bad_input,
                    error && error != std::errc::no_such_file_or_directory
                        ? "cannot be opened (" + error.message() + ")"
                        : "there is no such file or folder",
                    path.string());
    }
    if (std::filesystem::is_directory(status)) return open_photographs(path, options);
    if (!std::filesystem::is_regular_file(status)) {
        throw Error(ErrorCode::bad_input, "is neither a file nor a folder", path.string());
    }
    if (looks_like_image(path)) {
        throw Error(ErrorCode::bad_input,
                    "is one picture; a recording needs a folder of them or a video", path.string());
    }
    return open_video(path, options);
}

}  // namespace verdigris
