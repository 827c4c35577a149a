// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace verdigris {
namespace {

void leak(Statuses& findings, const char* id, std::string sentence) {
    findings.push_back({id, Severity::refusal, std::move(sentence)});
}

const RecordingRecord* find(const EvaluationRecord& record, const std::string& name) {
    for (const RecordingRecord& r : record.recordings) {
        if (r.name == name) return &r;
    }
    return nullptr;
}

/// Every sample a use touches: all of each window's span, as its neighbors look alike.
std::set<int> samples_of(const SampleUse& use, int span) {
    std::set<int> all(use.samples.begin(), use.samples.end());
    for (const int start : use.starts) {
        for (int i = 0; i <= span; ++i) all.insert(start + i);
    }
    return all;
}

/// Samples strictly between the nearest two of different sets; -1 if they share one.
int samples_between(const std::set<int>& a, const std::set<int>& b) {
    int least = std::numeric_limits<int>::max();
    for (const int s : a) {
        const auto next = b.lower_bound(s);
        if (next != b.end()) least = std::min(least, *next - s - 1);
        if (next != b.begin()) least = std::min(least, s - *std::prev(next) - 1);
    }
    return least;
}

void check_recordings(const EvaluationRecord& record, Statuses& findings) {
    for (std::size_t i = 0; i < record.recordings.size(); ++i) {
        const RecordingRecord& a = record.recordings[i];
        if (a.frame_hashes.empty()) {
            findings.push_back({"frames_not_hashed", Severity::info,
                                fmt::format("the frames of {} were not hashed, so a copy of one of "
                                            "them elsewhere would not be noticed",
                                            a.name)});
        }
        for (std::size_t j = 0; j < i; ++j) {
            const RecordingRecord& b = record.recordings[j];
            if (!a.sha256.empty() && a.sha256 == b.sha256) {
                leak(findings, "same_recording_twice",
                     fmt::format("{} and {} are the same file", b.name, a.name));
                continue;
            }
            const std::set<std::string> frames(b.frame_hashes.begin(), b.frame_hashes.end());
            const auto shared = std::ranges::count_if(
                a.frame_hashes, [&](const std::string& h) { return frames.contains(h); });
            if (shared > 0) {
                leak(findings, "same_recording_twice",
                     fmt::format("{} and {} share {} identical frames", b.name, a.name, shared));
                continue;
            }
            const double likeness = surface_likeness(b.surface, a.surface);
            if (likeness >= kNearCopy) {
                leak(findings, "near_copy_of_recording",
                     near_copy_sentence(b.name, a.name, likeness));
            }
        }
    }
}

void check_use(const EvaluationRecord& record, const SampleUse& use, Statuses& findings) {
    const RecordingRecord* recording = find(record, use.recording);
    if (recording == nullptr) {
        leak(findings, "unknown_recording",
             fmt::format("{} samples come from {}, which is no recording of this evaluation",
                         to_string(use.role), use.recording));
        return;
    }
    int crossing = 0, first = 0;
    for (const int start : use.starts) {
        if (use.allowed.contains(start) && use.allowed.contains(start + record.span)) continue;
        if (crossing++ == 0) first = start;
    }
    if (crossing > 0) {
        leak(findings, "window_crosses_split",
             fmt::format("{} {} windows of {} reach beyond samples {} to {}, the first one from "
                         "sample {} to {}",
                         crossing, to_string(use.role), use.recording, use.allowed.begin,
                         use.allowed.end - 1, first, first + record.span));
    }
    const auto outside =
        std::ranges::count_if(use.samples, [&](int s) { return !use.allowed.contains(s); });
    if (outside > 0) {
        leak(findings, "sample_outside_split",
             fmt::format("{} {} samples of {} lie outside of samples {} to {}", outside,
                         to_string(use.role), use.recording, use.allowed.begin,
                         use.allowed.end - 1));
    }
    if (std::set<int>(use.starts.begin(), use.starts.end()).size() < use.starts.size()) {
        leak(findings, "window_twice",
             fmt::format("some {} windows of {} count more than once", to_string(use.role),
                         use.recording));
    }
    if (use.role == SampleRole::test && int(use.starts.size()) + use.skipped != use.planned) {
        leak(findings, "windows_missing",
             fmt::format("{} windows of {} were scored and {} skipped for a reason, but the "
                         "protocol names {}",
                         use.starts.size(), use.recording, use.skipped, use.planned));
    }
}

/// Hash to where it is used.
using HashedUses = std::map<std::string, std::pair<std::string, int>>;

HashedUses hashes_of(const EvaluationRecord& record, const SampleUse& use) {
    HashedUses out;
    const RecordingRecord* recording = find(record, use.recording);
    if (recording == nullptr || recording->frame_hashes.empty()) return out;
    for (const int s : samples_of(use, record.span)) {
        const int i = s - recording->usable.begin;
        if (i < 0 || i >= int(recording->frame_hashes.size())) continue;
        out.emplace(recording->frame_hashes[std::size_t(i)], std::pair(use.recording, s));
    }
    return out;
}

void check_pair(const EvaluationRecord& record, const SampleUse& a, const SampleUse& b,
                Statuses& findings) {
    const std::string roles = fmt::format("{} and {}", to_string(a.role), to_string(b.role));
    if (a.recording == b.recording) {
        const std::set<int> sa = samples_of(a, record.span), sb = samples_of(b, record.span);
        const int between =
            sa.empty() || sb.empty() ? std::numeric_limits<int>::max() : samples_between(sa, sb);
        if (between < 0) {
            leak(findings, "sample_in_two_splits",
                 fmt::format("{} of {} share samples", roles, a.recording));
        } else if (between < record.embargo) {
            leak(findings, "embargo_violated",
                 fmt::format("{} of {} come as near as {} samples; {} must lie between them", roles,
                             a.recording, between, record.embargo));
        }
    }
    const HashedUses ha = hashes_of(record, a), hb = hashes_of(record, b);
    int shared = 0;
    std::string example;
    for (const auto& [hash, where] : ha) {
        const auto other = hb.find(hash);
        // The same sample in both is already told above.
        if (other == hb.end() || other->second == where) continue;
        if (shared++ == 0) {
            example = fmt::format("sample {} of {} and sample {} of {}", where.second, where.first,
                                  other->second.second, other->second.first);
        }
    }
    if (shared > 0) {
        leak(findings, "frame_in_two_splits",
             fmt::format("{} share {} identical frames, for one {}", roles, shared, example));
    }
}

void check_direction(const EvaluationRecord& record, const DirectionRecord& direction,
                     Statuses& findings) {
    const RecordingRecord* held_out = find(record, direction.held_out);
    if (!direction.trained.empty() && (record.single || record.recordings.size() < 2)) {
        leak(findings, "trained_without_held_out",
             fmt::format("{} was trained, but no recording was held out",
                         fmt::join(direction.trained, ", ")));
    }
    for (const SampleUse& use : direction.uses) {
        check_use(record, use, findings);
        if (use.role == SampleRole::test) continue;
        const RecordingRecord* used = find(record, use.recording);
        const bool same =
            use.recording == direction.held_out ||
            (used && held_out && !used->sha256.empty() && used->sha256 == held_out->sha256);
        if (!same) continue;
        const bool training = use.role == SampleRole::train;
        leak(findings, training ? "test_recording_in_training" : "test_recording_in_selection",
             fmt::format("{} is held out, and its samples were used for {}", direction.held_out,
                         training ? "training" : "selection"));
    }
    for (std::size_t i = 0; i < direction.uses.size(); ++i) {
        for (std::size_t j = i + 1; j < direction.uses.size(); ++j) {
            if (direction.uses[i].role == direction.uses[j].role) continue;
            check_pair(record, direction.uses[i], direction.uses[j], findings);
        }
    }
}

}  // namespace

std::string to_string(SampleRole role) {
    switch (role) {
        case SampleRole::train:
            return "train";
        case SampleRole::validation:
            return "validation";
        case SampleRole::test:
            return "test";
    }
    return "unknown";
}

Statuses audit(const EvaluationRecord& record) {
    Statuses findings;
    check_recordings(record, findings);
    for (const DirectionRecord& d : record.directions) check_direction(record, d, findings);
    return findings;
}

}  // namespace verdigris
