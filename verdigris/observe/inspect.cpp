// SPDX-License-Identifier: MIT
#include "verdigris/observe/inspect.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/observe/binning.h"
#include "verdigris/observe/crop.h"
#include "verdigris/observe/drift.h"
#include "verdigris/observe/look.h"
#include "verdigris/observe/recent_frames.h"
#include "verdigris/observe/unit_axis.h"

namespace verdigris {
namespace {

// All chosen, for sentences; nothing is computed with them.
constexpr int kFewFrames = 5, kSomeFrames = 20;  // one context, and context plus horizon
constexpr double kMuchClipped = 0.05, kBigJump = 8;
constexpr double kNoisy = 0.03;  // 8 of 255: a phone in a dim room
constexpr double kUnevenSteps = 3;
constexpr double kSmallestJump = 0.02;  // of full scale: below, a jump does no harm

double median_of(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// The noise of single frames at full size, from looks an equal number of frames apart.
class FrameNoise {
  public:
    explicit FrameNoise(const RecordingInfo& info)
        : rows_(probe_rows({0, 0, info.width, info.height}, info.height)),
          meter_(info.width, rows_.rows) {}
    void add(const Frame& frame, const Image<SrgbF>& shown) {
        const int gap = frame.index - last_frame_;
        // Evenly spaced looks differ by one frame now and then; runs and jumps by far more.
        const bool even = last_frame_ >= 0 && gap_ > 0 && std::abs(gap - gap_) <= 1 + gap_ / 10;
        position_ += even || (last_frame_ >= 0 && gap_ == 0) ? 1 : 2;
        if (!even && last_frame_ >= 0 && gap_ > 0) {
            // The last look also starts the next run.
            meter_.add(position_++, last_);
        }
        gap_ = last_frame_ >= 0 ? gap : 0;
        last_frame_ = frame.index;
        last_ = Image<SrgbF>::for_overwrite(shown.width(), rows_.rows);
        int row = 0;
        for (const auto& [begin, end] : rows_.bands) {
            for (int y = begin; y < end; ++y) {
                std::copy_n(shown.row(y), shown.width(), last_.row(row++));
            }
        }
        meter_.add(position_, last_);
    }
    std::optional<double> sigma(const Mask& specimen) const {
        return meter_.sigma(probe_of(specimen, rows_));
    }

  private:
    ProbeRows rows_;
    NoiseMeter meter_;
    Image<SrgbF> last_;
    int last_frame_ = -1, gap_ = 0, position_ = 0;
};

void measure_times(const std::vector<double>& times, Inspection& out) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
    out.duration_seconds = times.back() - times.front();
    out.median_step_seconds = median_of(steps);
    out.longest_step_seconds = *std::max_element(steps.begin(), steps.end());
    if (out.median_step_seconds > 0 &&
        out.longest_step_seconds > kUnevenSteps * out.median_step_seconds) {
        out.findings.push_back(
            {"gap_in_time", Severity::caution,
             fmt::format("the longest gap between frames is {:.1f} times the usual one; samples "
                         "inside it are interpolated",
                         out.longest_step_seconds / out.median_step_seconds)});
    }
}

void measure_steps(const Look& look, const SpecimenFinding& finding, Inspection& out) {
    // Looks at a video are runs of neighbors with long gaps between: only steps of about the
    // shortest gap are like one another, and a gap full of aging is no jump.
    int shortest = std::numeric_limits<int>::max();
    for (std::size_t i = 1; i < look.frames.size(); ++i) {
        shortest = std::min(shortest, look.index[i] - look.index[i - 1]);
    }
    std::vector<double> steps;
    std::vector<int> arrives;
    for (std::size_t i = 1; i < look.frames.size(); ++i) {
        if (2 * (look.index[i] - look.index[i - 1]) > 3 * shortest) continue;
        double sum = 0;
        const auto a = look.frames[i - 1].pixels(), b = look.frames[i].pixels();
        for (std::size_t p = 0; p < a.size(); ++p) {
            sum += double(std::fabs(a[p].r - b[p].r) + std::fabs(a[p].g - b[p].g) +
                          std::fabs(a[p].b - b[p].b)) /
                   3;
        }
        steps.push_back(sum / double(a.size()));
        arrives.push_back(look.index[i]);
    }
    if (steps.empty()) return;
    const auto largest = std::max_element(steps.begin(), steps.end());
    // An eighth of an 8-bit step: a still video has steps of nothing.
    out.largest_jump = *largest / std::max(median_of(steps), 5e-4);
    out.largest_jump_frame = arrives[std::size_t(largest - steps.begin())];
    if (out.largest_jump > kBigJump && *largest > kSmallestJump) {
        out.findings.push_back(
            {"jump", Severity::caution,
             fmt::format("the picture jumps before frame {}, by {:.0f} times the usual step: the "
                         "camera, the light or the specimen was moved, or exposure is not locked",
                         out.largest_jump_frame, out.largest_jump)});
    }
    std::size_t inside = 0, clipped = 0;
    for (std::size_t p = 0; p < finding.mask.pixel_count(); ++p) {
        if (finding.mask.pixels()[p] != kInside) continue;
        ++inside;
        clipped += std::any_of(look.frames.begin(), look.frames.end(),
                               [&](const auto& frame) { return is_clipped(frame.pixels()[p]); });
    }
    out.clipped_share = inside > 0 ? double(clipped) / double(inside) : 0;
    if (out.clipped_share > kMuchClipped) {
        out.findings.push_back(
            {"clipped", Severity::caution,
             fmt::format("{:.0f} % of the specimen is overexposed or black in some frame; colors "
                         "cannot be forecast there: expose darker, or move the lamp",
                         100 * out.clipped_share)});
    }
}

void judge_specimen(const SpecimenFinding& finding, Inspection& out) {
    if (finding.kind == SpecimenKind::still) {
        out.findings.push_back({"still_scene", Severity::refusal,
                                "nothing in the frame changes by more than the noise; there is "
                                "nothing to forecast"});
    } else if (finding.kind == SpecimenKind::ambiguous) {
        out.findings.push_back({"specimen_unclear", Severity::caution, out.crop_sentence});
    }
    if (out.noise_sigma > kNoisy) {
        out.findings.push_back(
            {"noisy", Severity::caution,
             fmt::format("single frames are noisy ({:.1f} of 255 per channel); more light or more "
                         "frames help",
                         255 * out.noise_sigma)});
    }
}

void judge_length(int frames, Inspection& out) {
    if (frames < kFewFrames) {
        out.findings.push_back(
            {"few_frames", Severity::refusal,
             fmt::format("only {} frames; a forecast wants at least {}", frames, kFewFrames)});
    } else if (frames < kSomeFrames) {
        out.findings.push_back(
            {"few_frames", Severity::caution,
             fmt::format("only {} frames; a check against the recording's own end "
                         "rests on very few of them",
                         frames)});
    }
}

// chosen: what spoils a forecast most comes first. Whether there is something to forecast, whether
// it is the copper that moves, whether its color can be seen, how long it was watched, when; then
// what is not listed: how the file says its times and colors.
constexpr std::array kWeightiest{
    "still_scene",         "specimen_unclear", "jump",          "exposure_drift",
    "white_balance_drift", "clipped",          "noisy",         "broken_tail",
    "lost_frames",         "few_frames",       "one_frame",     "times_equal",
    "gap_in_time",         "times_repeat",     "light_unknown", "irregular_times",
};

auto rank_of(const Status& finding) {
    return std::find(kWeightiest.begin(), kWeightiest.end(), finding.id) - kWeightiest.begin();
}

void pass_verdict(Inspection& out) {
    std::stable_sort(out.findings.begin(), out.findings.end(),
                     [](const Status& a, const Status& b) {
                         if (a.severity != b.severity) return a.severity > b.severity;
                         return rank_of(a) < rank_of(b);
                     });
    const auto count = [&](Severity s) {
        return std::count_if(out.findings.begin(), out.findings.end(),
                             [&](const Status& f) { return f.severity == s; });
    };
    const auto refusals = count(Severity::refusal), cautions = count(Severity::caution);
    const std::string reason = out.findings.empty() ? "" : ": " + out.findings.front().sentence;
    if (refusals > 0) {
        out.verdict = out.frames < 2 ? Verdict::unusable : Verdict::poor;
        out.verdict_sentence = (out.frames < 2 ? "this recording cannot be used"
                                               : "a forecast from this recording "
                                                 "would mean little") +
                               reason;
    } else if (cautions > 1) {
        out.verdict = Verdict::poor;
        out.verdict_sentence = fmt::format(
            "{} things limit a forecast from this recording; the weightiest{}", cautions, reason);
    } else if (cautions == 1) {
        out.verdict = Verdict::usable;
        out.verdict_sentence = "usable" + reason;
    } else {
        out.verdict = Verdict::good;
        out.verdict_sentence =
            out.drift_known ? "good: the specimen changes clearly under steady light"
                            : "good: the specimen changes clearly; whether the light is steady "
                              "cannot be seen without a backdrop";
    }
}

/// Frames that cannot be read have had their finding; there is less to look at then, no error.
RecentUnits whatever_is_recent(const Recording& recording, const Look& look,
                               const SpecimenFinding& finding, Rect crop, const AxisPlan& axis,
                               const Progress& progress) {
    try {
        return recent_units(recording, look, finding, crop, axis, progress);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::interrupted) throw;
        return {};
    }
}

Inspection inspected(const Recording& recording, const Progress& progress, RecentUnits* recent) {
    const RecordingInfo& info = recording.info();
    if (std::min(info.width, info.height) < 2) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("its frames are {} x {} pixels: there is nothing to see",
                                info.width, info.height),
                    info.path.filename().string());
    }
    Inspection out;
    out.frames = int(info.times.size());
    out.findings = info.notes;
    FrameNoise noise(info);
    const Look look = look_at(recording, progress, [&](const Frame& frame, const auto& shown) {
        noise.add(frame, shown);
    });
    if (look.decodable < out.frames) {
        out.findings.push_back({"broken_tail", Severity::caution,
                                fmt::format("the recording breaks off: {} of {} frames can be "
                                            "decoded",
                                            look.decodable, out.frames)});
        out.frames = look.decodable;
    }
    out.crop = {0, 0, info.width, info.height};
    if (out.frames < 2 || look.frames.size() < 2) {
        out.frames = std::min(out.frames, 1);
        out.crop_sentence = "one frame does not show what changes";
        out.findings.push_back({"one_frame", Severity::refusal,
                                "there is one frame only; a recording needs at least 2"});
        pass_verdict(out);
        return out;
    }
    const std::vector<double> times(info.times.begin(), info.times.begin() + out.frames);
    measure_times(times, out);
    const AxisPlan axis = plan_axis(times, std::nullopt);
    out.units = axis.axis.units;
    out.samples_per_unit = axis.axis.samples_per_unit;
    out.findings.insert(out.findings.end(), axis.notes.begin(), axis.notes.end());

    const SpecimenFinding finding = find_specimen(look);
    const CropReport crop = crop_report(finding, look);
    out.crop = crop.rect;
    out.crop_sentence = crop.sentence;
    out.specimen_change = finding.change;
    const Mask specimen =
        specimen_mask(finding, look, {0, 0, info.width, info.height}, info.width, info.height);
    out.noise_sigma =
        noise.sigma(specimen).value_or(spatial_sigma(look.frames.back(), finding.mask));
    const Drift drift = measure_drift(finding);
    out.exposure_drift = drift.exposure;
    out.white_balance_drift = drift.white_balance;
    out.drift_known = drift.known;

    judge_length(out.frames, out);
    judge_specimen(finding, out);
    measure_steps(look, finding, out);
    note_drift(drift, out.findings);
    pass_verdict(out);
    if (recent != nullptr)
        *recent = whatever_is_recent(recording, look, finding, out.crop, axis, progress);
    return out;
}

}  // namespace

Inspection inspect(const Recording& recording, const Progress& progress) {
    return inspected(recording, progress, nullptr);
}

Inspection inspect(const Recording& recording, RecentUnits& recent, const Progress& progress) {
    recent = {};
    return inspected(recording, progress, &recent);
}

std::string to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::good:
            return "good";
        case Verdict::usable:
            return "usable";
        case Verdict::poor:
            return "poor";
        case Verdict::unusable:
            return "unusable";
    }
    return "unusable";
}

}  // namespace verdigris
