// SPDX-License-Identifier: MIT
// The leakage audit: given what an evaluation used, did anything that was judged on leak into what
// was learned or chosen?
#pragma once

#include <string>
#include <vector>

#include "verdigris/evaluate/near_copy.h"
#include "verdigris/evaluate/windows.h"
#include "verdigris/status.h"

namespace verdigris {

/// A recording that took part.
struct RecordingRecord {
    std::string name;
    std::string sha256;  ///< of the input bytes; may be empty
    int samples = 0;
    SampleRange usable;
    std::vector<std::string> frame_hashes;  ///< one per usable sample; empty: not hashed
    SurfacePrint surface{};                 ///< knows a re-encoded or rescaled copy again
};

enum class SampleRole { train, validation, test };
std::string to_string(SampleRole role);  ///< "train", "validation", "test"

/// Samples of one recording in one role. Windows cover every sample from their first to their last.
struct SampleUse {
    SampleRole role{};
    std::string recording;
    SampleRange allowed;       ///< the split they must stay in
    std::vector<int> starts;   ///< first samples of windows
    std::vector<int> samples;  ///< samples read one by one
    int planned = 0;  ///< test: windows the protocol names, scored or skipped with a reason
    int skipped = 0;  ///< test: of these, skipped with a reason
};

/// One held-out recording and what was used for it.
struct DirectionRecord {
    std::string held_out;
    std::vector<std::string> trained;  ///< names of trained forecasters
    std::vector<SampleUse> uses;
};

struct EvaluationRecord {
    int span = 0;     ///< samples from a window's first to its last
    int embargo = 0;  ///< samples that must lie between train and validation
    bool single = false;
    std::vector<RecordingRecord> recordings;
    std::vector<DirectionRecord> directions;
};

/// Empty if nothing leaked. Ids, all refusals: "same_recording_twice",
/// "near_copy_of_recording", "test_recording_in_training", "test_recording_in_selection",
/// "window_crosses_split", "sample_outside_split", "sample_in_two_splits", "embargo_violated",
/// "frame_in_two_splits", "trained_without_held_out", "windows_missing", "window_twice",
/// "unknown_recording"; an info: "frames_not_hashed". Trusts the record: what it does not name it
/// cannot catch (see peeking.h for forecasters that look where they should not). O(samples log
/// samples).
Statuses audit(const EvaluationRecord& record);

}  // namespace verdigris
