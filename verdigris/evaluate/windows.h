// SPDX-License-Identifier: MIT
// Which samples of a recording are used for what: windows, and the splits of a source recording.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verdigris/evaluate/protocol.h"

namespace verdigris {

/// Samples [begin, end) of a recording, counted from its first sample.
struct SampleRange {
    int begin = 0, end = 0;
    int count() const { return end - begin; }
    bool contains(int sample) const { return sample >= begin && sample < end; }
    bool operator==(const SampleRange&) const = default;
};

/// train | embargo | validation | unused, one after the other, together the usable range.
struct RecordingSplits {
    SampleRange train, embargo, validation, unused;
};

/// How one recording is cut up.
struct WindowPlan {
    int samples = 0;          ///< of the recording
    SampleRange usable;       ///< without the trimmed ends
    int span = 0;             ///< samples from a window's first to its last
    int all_starts = 0;       ///< valid window starts
    std::vector<int> starts;  ///< first samples of the windows to evaluate, increasing
    int independent = 0;      ///< floor(usable / span): windows that share no sample
    /// Of a recording that something is trained on; empty if they do not fit, `splits_problem`
    /// says why.
    std::optional<RecordingSplits> splits;
    std::string splits_problem;
};

/// Throws Error{usage} as check_protocol, Error{bad_input} (`name` is where): not the grid's number
/// of samples, too short for one window.
WindowPlan plan_windows(const EvaluationProtocol& protocol, int samples,
                        const std::string& name = {});

/// Windows that lie inside `range` from first to last sample: count() - span, none if negative.
int windows_inside(SampleRange range, int span);

/// The samples of the window that starts at `start`: start, start + stride, ..., n + K of them.
std::vector<int> window_samples(const EvaluationProtocol& protocol, int start);

}  // namespace verdigris
