// SPDX-License-Identifier: MIT
#include "verdigris/observe/recent_frames.h"

#include <algorithm>
#include <cmath>

#include "verdigris/observe/area_average.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

// chosen: in trials on simulated presets and real copper more than ten told hardly anything, and a
// forecast of forty takes eight times as long.
constexpr int kMostUnits = 20;
// chosen: of videos 7 to 12 units, between what a forecast learns something from and what it looks
// at if nobody says otherwise.
constexpr int kFewestOfVideo = 7, kMostOfVideo = 12;
// chosen: and else so many that this share of its frames is decoded; half of what the look may
// cost.
constexpr double kShare = 0.02, kLeastDecoded = 60;
constexpr double kFramesPerJump = 125;  // see look.cpp

/// The last frame of each unit step, oldest first; -1 where a step is empty. The first is none.
std::vector<int> last_of_units(const AxisPlan& plan) {
    const std::vector<bool> kept = kept_samples(plan.axis, Keep::unit_steps);
    std::vector<int> last_in_bin(kept.size(), -1);
    for (std::size_t i = 0; i < plan.bin_of_frame.size(); ++i)
        last_in_bin[std::size_t(plan.bin_of_frame[i])] = int(i);
    std::vector<int> out;
    for (std::size_t bin = kept.size(); bin-- > 0;) {
        if (kept[bin]) out.push_back(last_in_bin[bin]);
    }
    std::reverse(out.begin(), out.end());
    return out;
}

int units_to_read(const RecordingInfo& info, const Look& look, int frames, double per_unit) {
    if (info.kind == RecordingKind::photographs || int(look.frames.size()) == frames)
        return kMostUnits;
    const double decoded = std::max(kLeastDecoded, kShare * frames);
    return std::clamp(int(1 + decoded / std::min(per_unit, kFramesPerJump)), kFewestOfVideo,
                      kMostOfVideo);
}

/// The part `rect` of a look, small.
Image<SrgbF> small(const Image<SrgbF>& look, Rect rect) {
    Image<SrgbF> part = Image<SrgbF>::for_overwrite(rect.width, rect.height);
    for (int y = 0; y < rect.height; ++y)
        std::copy_n(look.row(rect.y + y) + rect.x, rect.width, part.row(y));
    if (std::max(rect.width, rect.height) <= kRecentSide) return part;
    const auto [w, h] = size_with_long_side(rect.width, rect.height, kRecentSide);
    return resample(part, w, h);
}

/// From the frame to a look of it.
Rect in_look(Rect crop, const Look& look) {
    const auto& size = look.frames.front();
    const double sx = double(size.width()) / look.frame_width,
                 sy = double(size.height()) / look.frame_height;
    const int x = std::clamp(int(std::lround(crop.x * sx)), 0, size.width() - 1),
              y = std::clamp(int(std::lround(crop.y * sy)), 0, size.height() - 1);
    return {x, y, std::clamp(int(std::lround(crop.width * sx)), 1, size.width() - x),
            std::clamp(int(std::lround(crop.height * sy)), 1, size.height() - y)};
}

/// Pictures that are missing, half-way between those beside them, as observe has it for samples
/// that no frame falls into.
void fill_gaps(std::vector<Image<SrgbF>>& frames) {
    for (std::size_t i = 0; i < frames.size();) {
        if (!frames[i].empty()) {
            ++i;
            continue;
        }
        std::size_t next = i;
        while (next < frames.size() && frames[next].empty()) ++next;
        if (next == frames.size()) return frames.resize(i);
        const Image<SrgbF>&a = frames[i - 1], &b = frames[next];
        const auto steps = float(next - i + 1);
        for (float k = 1; i < next; ++i, ++k) {
            const float t = k / steps;
            frames[i] = Image<SrgbF>::for_overwrite(a.width(), a.height());
            for (std::size_t at = 0; at < a.pixels().size(); ++at) {
                const SrgbF p = a.pixels()[at], q = b.pixels()[at];
                frames[i].pixels()[at] = {p.r + t * (q.r - p.r), p.g + t * (q.g - p.g),
                                          p.b + t * (q.b - p.b)};
            }
        }
    }
}

}  // namespace

RecentUnits recent_units(const Recording& recording, const Look& look,
                         const SpecimenFinding& finding, Rect crop, const AxisPlan& plan,
                         const Progress& progress) {
    const RecordingInfo& info = recording.info();
    const int frames = int(plan.bin_of_frame.size());
    RecentUnits out;
    out.frames_recorded = frames;
    out.units = plan.axis.units;
    out.frames_per_unit = frames / plan.axis.units;
    const bool told = info.time_source != TimeSource::file_order;
    out.seconds_per_unit = told ? plan.axis.seconds_per_unit : 0;
    out.frames_per_sample = std::max(1.0, double(frames) / plan.axis.samples);
    out.still = finding.kind == SpecimenKind::still;
    if (out.still) return out;

    std::vector<int> wanted = last_of_units(plan);
    const int most = units_to_read(info, look, frames, out.frames_per_unit);
    if (int(wanted.size()) > most) wanted.erase(wanted.begin(), wanted.end() - most);
    const auto is_there = [](int frame) { return frame >= 0; };
    wanted.erase(wanted.begin(), std::find_if(wanted.begin(), wanted.end(), is_there));
    const Rect rect = in_look(crop, look);
    std::unique_ptr<FrameReader> reader;
    Frame frame;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        report(progress, "look", std::int64_t(i), std::int64_t(wanted.size()));
        if (wanted[i] < 0) {
            if (!out.frames.empty()) out.frames.emplace_back();
            continue;
        }
        const auto seen = std::find(look.index.begin(), look.index.end(), wanted[i]);
        if (seen != look.index.end()) {
            out.frames.push_back(small(look.frames[std::size_t(seen - look.index.begin())], rect));
            continue;
        }
        if (!reader) reader = recording.read();
        reader->seek(wanted[i]);
        if (!reader->next(frame) || frame.index != wanted[i]) {
            if (!out.frames.empty()) out.frames.emplace_back();
            reader.reset();
            continue;
        }
        const Image<SrgbF> shown =
            srgb_from_planes(frame.planes, info.format, {0, 0, info.width, info.height});
        out.frames.push_back(small(look_sized(shown), rect));
    }
    fill_gaps(out.frames);
    if (out.frames.empty()) return out;
    out.specimen =
        specimen_mask(finding, look, crop, out.frames.front().width(), out.frames.front().height());
    return out;
}

}  // namespace verdigris
