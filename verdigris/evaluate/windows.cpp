// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/windows.h"

#include <fmt/core.h>

#include <algorithm>

#include "verdigris/error.h"

namespace verdigris {
namespace {

/// Empty where they do not fit.
std::optional<RecordingSplits> split(const EvaluationProtocol& protocol, SampleRange usable,
                                     int total, std::string& problem) {
    const int train = int(protocol.train_fraction * total);
    const int validation = int(protocol.validation_fraction * total);
    const int embargo = protocol.embargo_samples();
    if (train + embargo + validation > usable.count()) {
        problem = fmt::format(
            "{} samples of training, {} of embargo and {} of validation do not fit into {}", train,
            embargo, validation, usable.count());
        return std::nullopt;
    }
    RecordingSplits s;
    s.train = {usable.begin, usable.begin + train};
    s.embargo = {s.train.end, s.train.end + embargo};
    s.validation = {s.embargo.end, s.embargo.end + validation};
    s.unused = {s.validation.end, usable.end};
    return s;
}

}  // namespace

int windows_inside(SampleRange range, int span) {
    return std::max(0, range.count() - span);
}

std::vector<int> window_samples(const EvaluationProtocol& protocol, int start) {
    std::vector<int> samples;
    for (int i = 0; i < protocol.context + protocol.horizons; ++i) {
        samples.push_back(start + i * protocol.stride);
    }
    return samples;
}

WindowPlan plan_windows(const EvaluationProtocol& protocol, int samples, const std::string& name) {
    check_protocol(protocol);
    if (protocol.grid > 0 && samples != protocol.grid) {
        throw Error(
            ErrorCode::bad_input,
            fmt::format("has {} samples, and the protocol's grid asks for {}; observe it "
                        "with every sample kept, or set the grid to 0 to take what there is",
                        samples, protocol.grid),
            name);
    }
    WindowPlan plan;
    plan.samples = samples;
    plan.span = protocol.span();
    plan.usable = {protocol.trim_lead, samples - protocol.trim_tail};
    plan.all_starts = windows_inside(plan.usable, plan.span);
    if (plan.all_starts == 0) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("is too short: {} usable samples, and one window of {} + {} frames "
                                "at {} samples per unit spans {}",
                                std::max(plan.usable.count(), 0), protocol.context,
                                protocol.horizons, protocol.stride, plan.span + 1),
                    name);
    }
    plan.independent = plan.usable.count() / plan.span;
    const int wanted = protocol.max_windows > 0 ? std::min(protocol.max_windows, plan.all_starts)
                                                : plan.all_starts;
    for (int i = 0; i < wanted; ++i) {  // evenly spaced, the first and the last among them
        const auto at = wanted == 1 ? 0 : std::int64_t(i) * (plan.all_starts - 1) / (wanted - 1);
        plan.starts.push_back(plan.usable.begin + int(at));
    }
    plan.splits = split(protocol, plan.usable, protocol.grid > 0 ? protocol.grid : samples,
                        plan.splits_problem);
    return plan;
}

}  // namespace verdigris
