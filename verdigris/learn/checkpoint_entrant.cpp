// SPDX-License-Identifier: MIT
#include "verdigris/learn/checkpoint_entrant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "verdigris/error.h"

namespace verdigris {
namespace {

void check_fits(const NamedCheckpoint& c, const EvaluationProtocol& protocol) {
    const NetworkConfig& config = c.checkpoint.network->config();
    const TrainingFacts& facts = c.checkpoint.facts;
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorCode::usage, why, c.path.string());
    };
    if (config.context != protocol.context) {
        refuse(fmt::format("was trained on contexts of {} frames; the protocol has {}",
                           config.context, protocol.context));
    }
    if (facts.stride != protocol.stride) {
        refuse(fmt::format("was trained with {} samples per unit; the protocol has {}",
                           facts.stride, protocol.stride));
    }
}

std::string described(const std::string& recording, SampleRange train, SampleRange validation) {
    return fmt::format("{}, samples {} to {}, validated on {} to {}", recording, train.begin,
                       train.end - 1, validation.begin, validation.end - 1);
}

std::string described(const NamedCheckpoint& c) {
    std::vector<std::string> list;
    for (const LearnedSource& s : c.checkpoint.facts.sources)
        list.push_back(described(s.recording, s.train, s.validation));
    const int size = c.checkpoint.network->config().size;
    return fmt::format("{} (learned from {}, at {} x {} pixels)", c.path.string(),
                       fmt::join(list, "; "), size, size);
}

/// Is this what it learned from? Splits first: only then may the samples be read.
bool is_source(const LearnedSource& learned, const TrainingSource& source) {
    const Observation& o = *source.observation;
    return learned.train == source.train && learned.validation == source.validation &&
           (learned.source_sha256.empty() || learned.source_sha256 == o.source_sha256) &&
           learned_data_hash(*o.store, source.train, source.validation) == learned.data_sha256;
}

/// Did it learn from these sources and from nothing else?
bool learned_from(const Checkpoint& checkpoint, const std::vector<TrainingSource>& sources) {
    return std::ranges::all_of(checkpoint.facts.sources, [&](const LearnedSource& learned) {
        return std::ranges::any_of(
            sources, [&](const TrainingSource& source) { return is_source(learned, source); });
    });
}

}  // namespace

Entrant checkpoint_entrant(std::string name, std::vector<NamedCheckpoint> checkpoints,
                           const EvaluationProtocol& protocol) {
    if (checkpoints.empty()) throw Error(ErrorCode::usage, "an entrant needs a checkpoint");
    for (const NamedCheckpoint& c : checkpoints) {
        check_fits(c, protocol);
        if (c.checkpoint.network->config() != checkpoints.front().checkpoint.network->config()) {
            throw Error(ErrorCode::usage,
                        fmt::format("is another network than {}: they cannot be one entrant",
                                    checkpoints.front().path.string()),
                        c.path.string());
        }
    }
    Entrant entrant;
    entrant.name = name;
    auto shared = std::make_shared<std::vector<NamedCheckpoint>>(std::move(checkpoints));
    entrant.train = [name, shared,
                     horizons = protocol.horizons](const std::vector<TrainingSource>& sources) {
        const NamedCheckpoint* best = nullptr;
        for (const NamedCheckpoint& c : *shared) {
            if (!learned_from(c.checkpoint, sources)) continue;
            if (best == nullptr ||
                c.checkpoint.facts.sources.size() > best->checkpoint.facts.sources.size()) {
                best = &c;
            }
        }
        if (best != nullptr)
            return as_forecaster(best->checkpoint.network, name, units_to(horizons));
        std::vector<std::string> have, want;
        for (const NamedCheckpoint& c : *shared) have.push_back(described(c));
        for (const TrainingSource& s : sources) {
            want.push_back(fmt::format("{} (at {} x {} pixels)",
                                       described(s.name, s.train, s.validation),
                                       s.observation->width(), s.observation->height()));
        }
        throw Error(ErrorCode::refused,
                    fmt::format("no checkpoint of {} learned from what may be learned from here: "
                                "there is {}; it would have to be {}, of the same file by the "
                                "same --size, --crop and --horizons. Train one more, or judge one "
                                "recording only with --hold-out",
                                name, fmt::join(have, ", "), fmt::join(want, " or ")));
    };
    return entrant;
}

std::vector<Entrant> checkpoint_entrants(std::vector<NamedCheckpoint> checkpoints,
                                         const EvaluationProtocol& protocol) {
    // Kind, then how many before it learned from the same samples.
    std::map<std::pair<NetworkKind, int>, std::vector<NamedCheckpoint>> groups;
    std::map<std::pair<NetworkKind, std::string>, int> seen;
    for (NamedCheckpoint& c : checkpoints) {
        const NetworkKind kind = c.checkpoint.network->config().kind;
        std::string learned;
        for (const LearnedSource& s : c.checkpoint.facts.sources) learned += s.data_sha256;
        const int again = seen[{kind, learned}]++;
        groups[{kind, again}].push_back(std::move(c));
    }
    std::vector<Entrant> entrants;
    for (auto& [key, group] : groups) {
        const std::string name = key.second == 0
                                     ? to_string(key.first)
                                     : fmt::format("{} {}", to_string(key.first), key.second + 1);
        entrants.push_back(checkpoint_entrant(name, std::move(group), protocol));
    }
    return entrants;
}

}  // namespace verdigris
