// SPDX-License-Identifier: MIT
// Videos of known frames, made by the ffmpeg command from raw samples that the test computed: no
// conversion of FFmpeg's is in the way.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/recording/frame_format.h"
#include "verdigris/recording/recording.h"
#include "verdigris/recording/testing/made_planes.h"
#include "verdigris/recording/testing/scratch.h"

namespace verdigris::testing {

inline bool run_ffmpeg(const std::string& arguments) {
    const std::string line = "ffmpeg -nostdin -v error -y " + arguments + " >/dev/null 2>&1";
    return std::system(line.c_str()) == 0;
}
inline bool have_ffmpeg() {
    static const bool have = run_ffmpeg("-version");
    return have;
}
inline bool have_encoder(const std::string& name) {
    return std::system(
               ("ffmpeg -nostdin -v error -h encoder=" + name + " 2>&1 | grep -q '^Encoder'")
                   .c_str()) == 0;
}

/// The samples of all planes of a frame, as -f rawvideo has them.
inline std::string raw_bytes(const PlaneSet& set) {
    std::string bytes;
    for (int p = 0; p < set.count; ++p) {
        const Plane& plane = set.plane[std::size_t(p)];
        const std::size_t row = std::size_t(plane.width) * std::size_t(plane.channels) *
                                (plane.type == SampleType::u8 ? 1 : 2);
        for (int y = 0; y < plane.height; ++y) {
            bytes.append(reinterpret_cast<const char*>(plane.data + y * plane.stride_bytes), row);
        }
    }
    return bytes;
}

struct RawVideo {
    std::string pixel_format;  ///< FFmpeg's name
    int width = 0, height = 0;
    std::string bytes;  ///< all frames
};

/// Encodes `raw` at 10 frames per second. False if the encoder does not want it.
inline bool encode(const RawVideo& raw, const std::string& codec, const std::filesystem::path& to) {
    const std::filesystem::path from = to.string() + ".raw";
    write_bytes(from, raw.bytes);
    return run_ffmpeg("-f rawvideo -pix_fmt " + raw.pixel_format + " -s " +
                      std::to_string(raw.width) + "x" + std::to_string(raw.height) + " -r 10 -i " +
                      from.string() + " " + codec + " " + to.string());
}

/// A moving pattern with noise: 320 x 180, 10 frames per second, a key frame every `gop` frames.
inline bool make_pattern(const std::filesystem::path& to, int frames, int gop,
                         const std::string& codec) {
    return run_ffmpeg("-f lavfi -i testsrc2=s=320x180:r=10:d=" + std::to_string(frames / 10.0) +
                      " -vf noise=alls=6:allf=t -pix_fmt yuv420p -g " + std::to_string(gop) + " " +
                      codec + " " + to.string());
}

/// FNV-1a of all samples: equal frames have equal marks.
inline std::uint64_t mark_of(const PlaneSet& set) {
    std::uint64_t hash = 14695981039346656037ull;
    for (const char c : raw_bytes(set)) {
        hash = (hash ^ std::uint64_t(static_cast<unsigned char>(c))) * 1099511628211ull;
    }
    return hash;
}

/// The marks of all frames that come out, 0 for those that do not.
inline std::vector<std::uint64_t> marks_of(const Recording& recording, FrameReader& reader) {
    std::vector<std::uint64_t> marks(recording.info().times.size());
    for (Frame frame; reader.next(frame);) {
        marks.at(std::size_t(frame.index)) = mark_of(frame.planes);
    }
    return marks;
}

}  // namespace verdigris::testing

#define NEEDS_FFMPEG()                                         \
    if (!verdigris::testing::have_ffmpeg()) {                  \
        GTEST_SKIP() << "the ffmpeg command is not installed"; \
    }
