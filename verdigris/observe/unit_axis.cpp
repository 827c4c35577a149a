// SPDX-License-Identifier: MIT
#include "verdigris/observe/unit_axis.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "verdigris/error.h"

namespace verdigris {
namespace {

// derived: 984 grid samples of which 950 are usable in the paper, 17 lost at each end.
constexpr int kPaperGrid = 984, kPaperTrim = 17;

double median_step(const std::vector<double>& times) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
    const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

// Regular: every stamp lies within half a step of its place on a straight line, so that on an even
// grid of as many bins every frame has a bin of its own. Rounded stamps (33, 33, 34 ms) are.
bool is_regular(const std::vector<double>& times) {
    const double step = (times.back() - times.front()) / double(times.size() - 1);
    for (std::size_t i = 1; i < times.size(); ++i) {
        if (std::fabs(times[i] - (times.front() + double(i) * step)) >= 0.5 * step) return false;
    }
    return true;
}

// Frames with one stamp come from a clock too coarse to tell them apart (two photographs in an EXIF
// second): they are spread evenly up to the next stamp. Returns how many repeat the one before.
int spread_repeated(std::vector<double>& times) {
    int repeated = 0;
    double step = 0;
    for (std::size_t begin = 0; begin < times.size();) {
        std::size_t end = begin + 1;
        while (end < times.size() && !(times[end] > times[begin])) ++end;
        const double from = times[begin];
        if (end < times.size()) step = times[end] - from;
        const auto count = end - begin;
        for (std::size_t i = 1; i < count; ++i) {
            times[begin + i] = from + step * double(i) / double(count);
        }
        repeated += int(count) - 1;
        begin = end;
    }
    return repeated;
}

}  // namespace

AxisPlan plan_axis(const std::vector<double>& stamps, std::optional<double> units) {
    const int frames = int(stamps.size());
    AxisPlan plan;
    std::vector<double> times = stamps;
    if (!(times.back() > times.front())) {
        for (int i = 0; i < frames; ++i) times[std::size_t(i)] = double(i);
        plan.notes.push_back({"times_equal", Severity::caution,
                              "all frames carry the same time; they are taken as evenly spaced"});
    } else if (const int repeated = spread_repeated(times); repeated > 0) {
        plan.notes.push_back({"times_repeat", Severity::caution,
                              std::to_string(repeated) + " of " + std::to_string(frames) +
                                  " frames " + (repeated == 1 ? "carries" : "carry") +
                                  " the same time as the frame before; they are "
                                  "spread evenly up to the next, as the clock of the recording "
                                  "seems to be too coarse or wrong"});
    }
    const bool regular = is_regular(times);
    plan.step_seconds = regular ? 0 : median_step(times);
    if (!(plan.step_seconds > 0)) {  // regular, or more than half of the stamps repeat
        plan.step_seconds = (times.back() - times.front()) / double(frames - 1);
    }
    plan.span_seconds = times.back() - times.front() + plan.step_seconds;

    UnitAxis& axis = plan.axis;
    if (units) {
        if (!(*units > 0) || !std::isfinite(*units)) {
            throw Error(ErrorCode::usage, "the number of units must be a positive number");
        }
        if (*units > double(frames)) {
            throw Error(ErrorCode::usage, "the recording has " + std::to_string(frames) +
                                              " frames; it cannot span more units than that");
        }
        axis.units = *units;
        axis.samples_per_unit =
            std::clamp(int(std::floor(double(frames) / *units)), 1, kMaxSamplesPerUnit);
        axis.samples = std::max(1, int(std::lround(*units * axis.samples_per_unit)));
    } else if (double(frames) < kFramesForUnitGrid) {
        axis.units = frames;
        axis.samples_per_unit = 1;
        axis.samples = frames;
    } else {
        axis.units = kUnitsPerRecording;
        axis.samples_per_unit =
            std::clamp(int(std::floor(double(frames) / kUnitsPerRecording)), 1, kMaxSamplesPerUnit);
        axis.samples = int(std::lround(kUnitsPerRecording * axis.samples_per_unit));
    }
    axis.seconds_per_unit = plan.span_seconds / axis.units;
    plan.one_frame_per_sample = regular && axis.samples == frames;

    plan.bin_of_frame.resize(std::size_t(frames));
    plan.frames_in_bin.assign(std::size_t(axis.samples), 0);
    const double width = plan.span_seconds / axis.samples;
    for (int i = 0; i < frames; ++i) {
        // A frame stands for the step that follows its stamp; its middle decides.
        const double middle = times[std::size_t(i)] - times.front() + 0.5 * plan.step_seconds;
        const int bin = plan.one_frame_per_sample
                            ? i
                            : std::clamp(int(std::floor(middle / width)), 0, axis.samples - 1);
        plan.bin_of_frame[std::size_t(i)] = bin;
        ++plan.frames_in_bin[std::size_t(bin)];
    }
    if (!regular && (plan.notes.empty() || plan.notes.back().id == "times_repeat")) {
        plan.notes.push_back({"irregular_times", Severity::info,
                              "the frames are not evenly spaced in time; they are averaged on an "
                              "even grid"});
    }
    return plan;
}

std::vector<bool> kept_samples(const UnitAxis& axis, Keep keep) {
    std::vector<bool> kept(std::size_t(axis.samples), keep == Keep::every_sample);
    for (int i = axis.samples - 1; i >= 0; i -= axis.samples_per_unit) kept[std::size_t(i)] = true;
    return kept;
}

UnitAxis truncated(const UnitAxis& axis, int samples) {
    UnitAxis cut = axis;
    cut.samples = samples;
    cut.units = axis.units * samples / axis.samples;
    return cut;
}

std::pair<int, int> paper_valid_range(int samples) {
    const int trim = int(std::lround(double(kPaperTrim) * samples / kPaperGrid));
    return {trim, std::max(trim, samples - trim)};
}

}  // namespace verdigris
