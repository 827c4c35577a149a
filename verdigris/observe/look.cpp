// SPDX-License-Identifier: MIT
#include "verdigris/observe/look.h"

#include <algorithm>
#include <cmath>

#include "verdigris/error.h"
#include "verdigris/observe/area_average.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

// chosen: the median of four frames at each end.
constexpr int kInARow = 4;
// chosen: decoding this many frames one after another is cheaper than jumping.
constexpr int kReadThrough = 128;
// x264 and most cameras place a key frame every 250 frames or more often; a jump into the middle
// decodes half of that.
constexpr double kFramesPerJump = 125;
// chosen: the look may cost this share of decoding the recording.
constexpr double kLookShare = 0.04;

// Reads the frames `wanted`; false if the recording ends before the last of them.
bool read_looks(const Recording& recording, const std::vector<int>& wanted,
                const Progress& progress, const LookVisitor& visit, Look& look) {
    const RecordingInfo& info = recording.info();
    const auto reader = recording.read();
    Frame frame;
    int position = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        report(progress, "look", std::int64_t(i), std::int64_t(wanted.size()));
        if (wanted[i] < position) continue;  // a lost frame was passed over
        if (wanted[i] > position) reader->seek(wanted[i]);
        if (!reader->next(frame)) return false;
        position = frame.index + 1;
        const Image<SrgbF> shown =
            srgb_from_planes(frame.planes, info.format, {0, 0, info.width, info.height});
        if (visit) visit(frame, shown);
        look.frames.push_back(look_sized(shown));
        look.index.push_back(frame.index);
        look.decodable = position;
    }
    report(progress, "look", std::int64_t(wanted.size()), std::int64_t(wanted.size()));
    return true;
}

// How many frames there are up to the last one that decodes, between `good` and `bad`.
int decodable_frames(const Recording& recording, int good, int bad, const Progress& progress) {
    Frame frame;
    while (bad - good > kInARow) {
        report(progress, "look", 0, 0);
        const int middle = good + (bad - good) / 2;
        const auto reader = recording.read();
        reader->seek(middle);
        if (reader->next(frame) && frame.index < bad) {
            good = std::max(frame.index + 1, middle);
        } else {
            bad = middle;
        }
    }
    return good;
}

}  // namespace

std::vector<int> evenly(int of, int count) {
    std::vector<int> indices;
    for (int i = 0; i < count; ++i) {
        indices.push_back(count == 1 ? 0 : int(std::lround(double(i) * (of - 1) / (count - 1))));
    }
    return indices;
}

Image<SrgbF> look_sized(const Image<SrgbF>& shown) {
    if (std::max(shown.width(), shown.height()) <= kLookSide) return shown.clone();
    const auto [w, h] = size_with_long_side(shown.width(), shown.height(), kLookSide);
    return resample(shown, w, h);
}

std::vector<int> look_indices(RecordingKind kind, int frames) {
    if (frames <= kMaxLooks) return evenly(frames, frames);
    if (kind == RecordingKind::photographs || frames <= kReadThrough) {
        return evenly(frames, kMaxLooks);
    }
    const int jumps = std::clamp(int(kLookShare * frames / kFramesPerJump), 1, kMaxLooks - 8);
    const int between = jumps > 1 ? std::min(kInARow, (kMaxLooks - 2 * kInARow) / (jumps - 1)) : 0;
    std::vector<int> indices;
    for (int jump = 0; jump <= jumps; ++jump) {
        const int start = int(std::lround(double(jump) * (frames - kInARow) / jumps));
        const int count = jump == 0 || jump == jumps ? kInARow : between;
        for (int i = 0; i < count; ++i) {
            if (indices.empty() || start + i > indices.back()) indices.push_back(start + i);
        }
    }
    return indices;
}

Look look_at(const Recording& recording, const Progress& progress, const LookVisitor& visit) {
    const RecordingInfo& info = recording.info();
    int frames = int(info.times.size());
    for (;;) {
        Look look;
        look.frame_width = info.width;
        look.frame_height = info.height;
        const std::vector<int> wanted = look_indices(info.kind, frames);
        const bool complete = read_looks(recording, wanted, progress, visit, look);
        if (look.frames.empty()) {
            throw Error(ErrorCode::bad_input, "no frame could be decoded",
                        info.path.filename().string());
        }
        // A broken tail: find where it starts and look at what is before it. Where the frames
        // were read through, or nearly to the end, what was seen is enough.
        const int seen = look.decodable;
        const auto missed = std::upper_bound(wanted.begin(), wanted.end(), seen - 1);
        if (complete || missed == wanted.end() || frames <= kReadThrough) return look;
        const int decodable = decodable_frames(recording, seen, *missed, progress);
        if (decodable >= frames || decodable <= seen) return look;
        frames = decodable;
    }
}

}  // namespace verdigris
