// SPDX-License-Identifier: MIT
#include "verdigris/observe/observe.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "verdigris/error.h"
#include "verdigris/observe/area_average.h"
#include "verdigris/observe/binning.h"
#include "verdigris/observe/crop.h"
#include "verdigris/observe/drift.h"
#include "verdigris/observe/look.h"
#include "verdigris/observe/unit_axis.h"

namespace verdigris {
namespace {

// The forecast's smallest useful context is 5 samples, one per unit [Paper].
constexpr int kFewSamples = 5;

void check(const RecordingInfo& info, const ObserveOptions& options) {
    const std::string name = info.path.filename().string();
    if (info.times.size() < 2) {
        throw Error(ErrorCode::bad_input,
                    info.times.empty() ? "holds no frame"
                                       : "holds one frame only; a recording needs at least 2",
                    name);
    }
    constexpr int kMinSide = 2;  // chosen: one pixel has no neighbors to be told from
    if (std::min(info.width, info.height) < kMinSide) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("its frames are {} x {} pixels: there is nothing to see",
                                info.width, info.height),
                    name);
    }
    if (!(options.trim >= 0 && options.trim < 0.5)) {
        throw Error(ErrorCode::usage, "the trimmed share must be at least 0 and below 0.5");
    }
    if (options.size < 0) throw Error(ErrorCode::usage, "the size must not be negative");
    if (options.tau && !(*options.tau >= 0)) {
        throw Error(ErrorCode::usage, "the dead-zone tau must not be negative");
    }
    const Rect& r = options.crop.rect;
    if (options.crop.mode == CropMode::manual &&
        (r.width < 1 || r.height < 1 || r.x < 0 || r.y < 0 || r.width > info.width - r.x ||
         r.height > info.height - r.y)) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("the crop {},{},{},{} does not lie inside the frame of {} x {} "
                                "pixels",
                                r.x, r.y, r.width, r.height, info.width, info.height),
                    name);
    }
}

// The crop, and what the look says about specimen and light. With CropMode::none nothing is looked
// at before: the samples themselves are, afterwards.
struct Scene {
    CropReport crop;
    Look look;
    SpecimenFinding finding;
};

Scene choose_crop(const Recording& recording, const CropChoice& choice, const Progress& progress) {
    const RecordingInfo& info = recording.info();
    Scene scene;
    if (choice.mode == CropMode::none) {
        scene.crop.rect = {0, 0, info.width, info.height};
        scene.crop.frame_width = info.width;
        scene.crop.frame_height = info.height;
        scene.crop.sentence = "the whole frame is used, as asked";
        return scene;
    }
    scene.look = look_at(recording, progress);
    if (scene.look.decodable < 2 || scene.look.frames.size() < 2) {
        throw Error(ErrorCode::bad_input,
                    "only one frame could be decoded; a recording needs at least 2",
                    info.path.filename().string());
    }
    scene.finding = find_specimen(scene.look);
    scene.crop = crop_report(scene.finding, scene.look);
    if (choice.mode == CropMode::manual) {
        scene.crop.rect = choice.rect;
        scene.crop.sentence = "the part of the frame that was asked for is used";
        scene.crop.fills_frame = false;
    } else if (scene.finding.kind == SpecimenKind::ambiguous) {
        throw Error(ErrorCode::bad_input, scene.crop.sentence, info.path.filename().string());
    }
    return scene;
}

bool is_clear(const SpecimenFinding& finding) {
    return finding.kind == SpecimenKind::found;
}

Mask all_inside(int width, int height) {
    Mask mask(width, height);
    for (auto& m : mask.pixels()) m = kInside;
    return mask;
}

// The specimen inside the crop. Where the look found none, or the crop shows next to nothing of
// it, everything counts as specimen.
Mask specimen_in(const Scene& scene, int width, int height) {
    if (is_clear(scene.finding)) {
        Mask mask = specimen_mask(scene.finding, scene.look, scene.crop.rect, width, height);
        const auto inside = std::count(mask.pixels().begin(), mask.pixels().end(), kInside);
        // chosen: 1 %; less is not what somebody framed by hand.
        if (double(inside) >= 0.01 * double(mask.pixel_count())) return mask;
    }
    return all_inside(width, height);
}

void note_scene(Scene& scene, bool none_mode, Statuses& notes) {
    switch (scene.finding.kind) {
        case SpecimenKind::fills_frame:
            if (!none_mode && scene.crop.fills_frame) {
                notes.push_back({"fills_frame", Severity::info, scene.crop.sentence});
            }
            if (none_mode) scene.crop.fills_frame = true;
            break;
        case SpecimenKind::still:
            notes.push_back({"still_scene", Severity::caution,
                             "nothing in the frame changes by more than the noise; there may be "
                             "nothing to forecast"});
            if (none_mode) scene.crop.fills_frame = true;
            break;
        case SpecimenKind::ambiguous:
            notes.push_back({"specimen_unclear", Severity::caution,
                             "no part of the frame stands out as the specimen; all of it is "
                             "treated as specimen"});
            break;
        case SpecimenKind::found:
            break;
    }
    scene.crop.area_share = scene.finding.area_share;
    scene.crop.score_ratio = scene.finding.score_ratio;
}

void note_decoding(const DecodeReport& decode, int planned, int filled, Statuses& notes) {
    if (decode.lost == 0) return;
    const std::string why = decode.reason.empty() ? "" : " (" + decode.reason + ")";
    if (filled < planned) {
        notes.push_back({"broken_tail", Severity::caution,
                         fmt::format("{} of {} frames could not be decoded{}; the time axis ends "
                                     "with the last frame that could",
                                     decode.lost, decode.lost + decode.decoded, why)});
    } else {
        notes.push_back(
            {"lost_frames", Severity::caution,
             fmt::format("{} of {} frames could not be decoded, the first is frame "
                         "{}{}",
                         decode.lost, decode.lost + decode.decoded, decode.first_lost, why)});
    }
}

}  // namespace

Observation observe(const Recording& recording, const ObserveOptions& options,
                    const Progress& progress) {
    const RecordingInfo& info = recording.info();
    check(info, options);
    const AxisPlan axis = plan_axis(info.times, options.units);
    Scene scene = choose_crop(recording, options.crop, progress);
    const bool none_mode = options.crop.mode == CropMode::none;

    Observation out;
    BinningPlan plan;
    plan.axis = &axis;
    plan.kept = kept_samples(axis.axis, options.keep);
    plan.crop = scene.crop.rect;
    plan.trim = options.trim;
    plan.store = options.store;
    std::tie(plan.width, plan.height) =
        options.size > 0 ? size_with_long_side(plan.crop.width, plan.crop.height, options.size)
                         : std::pair{plan.crop.width, plan.crop.height};
    if (!none_mode) plan.specimen = specimen_in(scene, plan.width, plan.height);
    Binned binned = bin_recording(recording, plan, progress);

    out.notes = info.notes;
    out.notes.insert(out.notes.end(), axis.notes.begin(), axis.notes.end());
    out.store = binned.store;
    if (none_mode) {
        scene.look = std::move(binned.look);
        if (scene.look.frames.size() >= 2) {
            scene.finding = find_specimen(scene.look);
            note_scene(scene, true, out.notes);
        } else {
            scene.finding.kind = SpecimenKind::ambiguous;
        }
        out.specimen = specimen_in(scene, plan.width, plan.height);
    } else {
        note_scene(scene, false, out.notes);
        out.specimen = std::move(plan.specimen);
    }
    out.source_name = info.path.filename().string();
    out.source_sha256 = recording.sha256(progress);
    out.axis = truncated(axis.axis, binned.samples);
    out.crop = scene.crop;
    out.decode = binned.decode;
    out.clipped = std::move(binned.clipped);

    const double width_units = axis.axis.units / axis.axis.samples;
    const double width_seconds = axis.span_seconds / axis.axis.samples;
    int interpolated = 0;
    for (const auto& kept : binned.kept) {
        out.samples.push_back({(kept.bin + 0.5) * width_units, (kept.bin + 0.5) * width_seconds,
                               kept.frames, kept.frames == 0});
        interpolated += kept.frames == 0;
    }
    note_decoding(binned.decode, axis.axis.samples, binned.samples, out.notes);
    if (interpolated > 0) {
        out.notes.push_back({"interpolated_samples", Severity::caution,
                             fmt::format("{} of {} samples fall into gaps of the recording and are "
                                         "interpolated from their neighbors",
                                         interpolated, out.samples.size())});
    }
    if (int(out.samples.size()) < kFewSamples) {
        out.notes.push_back(
            {"few_frames", Severity::caution,
             fmt::format("only {} samples; a forecast wants at least {}, one per unit",
                         out.samples.size(), kFewSamples)});
    }

    std::optional<double> sigma = binned.sigma_of(out.specimen);
    if (!sigma) {
        const Image<SrgbF> last = out.store->image(out.store->count() - 1);
        sigma = spatial_sigma(last, out.specimen);
        const bool few = out.samples.size() - std::size_t(interpolated) < 3;
        out.notes.push_back(
            {"noise_from_space", Severity::caution,
             std::string(few ? "too few samples" : "nowhere three whole samples in a row") +
                 " to measure the noise over time (black, saturated and interpolated ones do not "
                 "count); it is estimated from the grain of the last one, where texture counts as "
                 "noise"});
    }
    out.noise = noise_from(*sigma, options.tau);
    note_drift(measure_drift(scene.finding), out.notes);
    if (binned.jump) out.notes.push_back(*binned.jump);
    return out;
}

}  // namespace verdigris
