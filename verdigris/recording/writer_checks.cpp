// SPDX-License-Identifier: MIT
#include "verdigris/recording/writer_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>

#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/recording/photo_writer.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_use(const fs::path& target, const std::string& sentence) {
    throw Error(ErrorCode::usage, sentence, target.string());
}

std::string extent(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

void check_mp4_options(const fs::path& target, const WriterOptions& options) {
    static constexpr std::array kPresets{"ultrafast", "superfast", "veryfast", "faster",
                                         "fast",      "medium",    "slow",     "slower",
                                         "veryslow",  "placebo"};
    if (options.bits == 16) {
        refuse_use(target, "an .mp4 holds 8 bits, not 16; write a .mkv or a folder instead");
    }
    if (options.width % 2 != 0 || options.height % 2 != 0) {
        refuse_use(target,
                   "an .mp4 needs an even width and height, because its colors are coded "
                   "for 2 x 2 pixels at once, but the frames are " +
                       extent(options.width, options.height) +
                       "; make them one pixel larger, or write a .mkv or a folder instead");
    }
    if (!(options.crf >= 0 && options.crf <= 51)) {
        refuse_use(target, "the constant rate factor (crf) must be between 0 and 51");
    }
    if (std::find(kPresets.begin(), kPresets.end(), options.preset) == kPresets.end()) {
        refuse_use(target, "there is no preset '" + options.preset +
                               "'; take one of ultrafast, superfast, veryfast, faster, fast, "
                               "medium, slow, slower, veryslow, placebo");
    }
}

}  // namespace

TargetKind target_kind(const fs::path& target) {
    const std::string name = target.string();
    if (name.empty()) refuse_use(target, "the name of the recording to write is missing");
    if (name.back() == '/') return TargetKind::folder;
    std::string ending = target.extension().string();
    for (char& c : ending) c = char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    if (ending == ".mp4") return TargetKind::mp4;
    if (ending == ".mkv") return TargetKind::mkv;
    if (ending.empty()) return TargetKind::folder;
    refuse_use(target, "a recording ending in '" + ending +
                           "' cannot be written; take .mp4 (H.264), .mkv (lossless), or a name "
                           "with '/' at the end for a folder of PNGs");
}

void check_options(const fs::path& target, const WriterOptions& options, TargetKind kind) {
    if (options.width < 1 || options.height < 1 ||
        std::int64_t(options.width) * options.height > kMaxImagePixels) {
        refuse_use(target, "frames of " + extent(options.width, options.height) +
                               " pixels cannot be written (at least 1 x 1, at most 2^28 in all)");
    }
    if (!(options.fps >= kLeastFps && options.fps <= kMostFps)) {
        refuse_use(target,
                   "the frame rate must be between one a day (1/86400) and 1000 per second");
    }
    if (options.bits != 8 && options.bits != 16) {
        refuse_use(target, "samples have 8 or 16 bits, not " + std::to_string(options.bits));
    }
    if (kind == TargetKind::mp4) check_mp4_options(target, options);
    // FFmpeg's encoder (5.1) cuts them into slices one pixel wide, which come back wrong.
    if (kind == TargetKind::mkv && std::min(options.width, options.height) < 4) {
        refuse_use(target, "an .mkv needs frames of at least 4 x 4 pixels, not " +
                               extent(options.width, options.height) + "; write a folder instead");
    }
}

void check_existing(const fs::path& target, bool replace, TargetKind kind) {
    std::error_code error;
    const auto status = fs::status(target, error);
    if (!fs::exists(status)) return;
    const auto refuse = [&](const std::string& sentence) {
        throw Error(ErrorCode::refused, sentence, target.string());
    };
    if ((kind == TargetKind::folder) != fs::is_directory(status)) {
        refuse(kind == TargetKind::folder ? "is a file, where a folder should be written"
                                          : "is a folder, where a video should be written");
    }
    if (kind == TargetKind::folder && fs::is_empty(target, error)) return;
    if (!replace) refuse("exists already and is not replaced unless that is asked for");
    if (kind == TargetKind::folder && !is_written_folder(target)) {
        refuse("is not replaced: it holds other things than numbered pictures and times.csv");
    }
}

bool is_written_folder(const fs::path& folder) {
    std::error_code error;
    int pictures = 0, tables = 0;
    long long last = -1;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (!fs::is_regular_file(entry->symlink_status(error))) return false;
        if (name == "times.csv") {
            ++tables;
            continue;
        }
        const std::size_t digits = name.find_first_not_of("0123456789");
        if (digits == 0 || digits > 9 || digits == std::string::npos) return false;
        const int index = std::stoi(name.substr(0, digits));
        if (name != picture_name(index)) return false;
        last = std::max(last, (long long)index);
        ++pictures;
    }
    return !error && tables == 1 && pictures > 0 && last == pictures - 1;
}

void check_frame(const fs::path& target, const WriterOptions& options, int index,
                 FrameShape shape) {
    const auto refuse = [&](const std::string& sentence) {
        throw Error(ErrorCode::usage, sentence,
                    target.string() + ", frame " + std::to_string(index));
    };
    if (shape.width != options.width || shape.height != options.height) {
        refuse("is " + extent(shape.width, shape.height) +
               " pixels, but the recording was announced as " +
               extent(options.width, options.height));
    }
    if (shape.bits != options.bits) {
        refuse("has " + std::to_string(shape.bits) +
               " bits per sample, but the recording was announced with " +
               std::to_string(options.bits));
    }
}

void check_any_frame(const fs::path& target, int frames) {
    if (frames == 0) refuse_use(target, "has no frames, so nothing is written");
}

}  // namespace verdigris
