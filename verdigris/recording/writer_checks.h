// SPDX-License-Identifier: MIT
// What write_recording refuses, in one sentence each. Internal.
#pragma once

#include <filesystem>

#include "verdigris/recording/recording_writer.h"

namespace verdigris {

enum class TargetKind { mp4, mkv, folder };

/// Of WriterOptions::fps. chosen: between them all times fit into the 32-bit ticks of an MP4.
inline constexpr double kLeastFps = 1.0 / 86400, kMostFps = 1000;

/// By the name alone. Throws Error{usage}.
TargetKind target_kind(const std::filesystem::path& target);

/// Throws Error{usage} naming `target`: an option out of its range.
void check_options(const std::filesystem::path& target, const WriterOptions& options,
                   TargetKind kind);

/// Throws Error{refused} naming `target` if something stands there that must stay: anything unless
/// `replace`, and even then a folder with more in it than a recording that we wrote.
void check_existing(const std::filesystem::path& target, bool replace, TargetKind kind);

/// True if the folder holds times.csv and 000000.png ... without a gap, and nothing else.
bool is_written_folder(const std::filesystem::path& folder);

struct FrameShape {
    int width = 0, height = 0, bits = 0;
};
/// Throws Error{usage} naming frame `index` of `target` if it is not what `options` announced.
void check_frame(const std::filesystem::path& target, const WriterOptions& options, int index,
                 FrameShape shape);

/// Throws Error{usage} naming `target` if there are no `frames`.
void check_any_frame(const std::filesystem::path& target, int frames);

}  // namespace verdigris
