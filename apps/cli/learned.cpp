// SPDX-License-Identifier: MIT
#include "learned.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "learned_commands.h"
#include "verdigris/error.h"
#include "verdigris/learn/checkpoint.h"
#include "verdigris/learn/checkpoint_entrant.h"
#include "verdigris/learn/lpips.h"

namespace verdigris::cli {

bool is_checkpoint(const std::string& name) {
    return name.ends_with(".safetensors");
}

void add_learned_commands(CLI::App& app, Session& session) {
    add_train(app, session);
    add_susceptibility(app, session);
    add_study(app, session);
}

std::string no_networks_because() {
    return {};
}

void check_checkpoints(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) read_checkpoint(path);
}

std::vector<Entrant> learned_entrants(const std::vector<std::string>& paths,
                                      const EvaluationProtocol& protocol) {
    std::vector<NamedCheckpoint> checkpoints;
    for (const std::string& path : paths) checkpoints.push_back({path, read_checkpoint(path)});
    return checkpoint_entrants(std::move(checkpoints), protocol);
}

LearnedForecaster learned_forecaster(const std::string& path, const std::vector<double>& horizons,
                                     const Observation& observation) {
    const Checkpoint checkpoint = read_checkpoint(path);
    const TrainingFacts& facts = checkpoint.facts;
    Statuses notes;
    const bool known = std::ranges::any_of(facts.sources, [&](const LearnedSource& s) {
        // Specimens of a study have no bytes.
        return !s.source_sha256.empty() && s.source_sha256 == observation.source_sha256;
    });
    if (!known) {
        notes.push_back({"trained_elsewhere", Severity::caution,
                         fmt::format("this network learned from {}, not from {}: on specimens they "
                                     "have never seen, networks have lost to holding still "
                                     "(docs/models/learn.md)",
                                     facts.source_names(), observation.source_name)});
    }
    // Whole units around each horizon; what lies between is interpolated.
    std::set<int> units;
    for (const double h : horizons) {
        if (h <= 0) continue;
        if (std::floor(h) >= 1) units.insert(int(std::floor(h)));
        units.insert(int(std::ceil(h)));
    }
    if (units.empty()) units.insert(1);
    if (*units.rbegin() > facts.horizons) {
        notes.push_back(
            {"beyond_training", Severity::caution,
             fmt::format("this network was trained to look {} units ahead; what it says "
                         "of {} units was never checked against anything",
                         facts.horizons, *units.rbegin())});
    }
    const std::string name = to_string(checkpoint.network->config().kind);
    return {as_forecaster(checkpoint.network, name, {units.begin(), units.end()}),
            checkpoint.network->config().context, std::move(notes)};
}

namespace {

constexpr const char* kNoWeights =
    "no weights: --lpips-weights names them, docs/models/metrics.md their making";

std::string too_small(const Lpips& lpips, int width, int height) {
    const int smallest = lpips_smallest(lpips.net());
    if (width >= smallest && height >= smallest) return {};
    return fmt::format("LPIPS of {} needs pictures of at least {} x {} pixels; these have {} x {}",
                       to_string(lpips.net()), smallest, smallest, width, height);
}

}  // namespace

LpipsOutcome lpips_of(const std::string& weights, const std::string& net,
                      const Image<SrgbF>& reference, const Image<SrgbF>& test) {
    LpipsOutcome out;
    if (weights.empty()) {
        out.why_not = kNoWeights;
        return out;
    }
    const Lpips lpips{weights};
    out.net = to_string(lpips.net());
    out.version = kLpipsVersion;
    if (!net.empty() && net != out.net)
        throw Error(ErrorCode::bad_input,
                    fmt::format("holds the weights of {}, and {} was asked for", out.net, net),
                    weights);
    use_cpu_for_networks(1);  // its last digits depend on how many there are
    out.why_not = too_small(lpips, reference.width(), reference.height());
    if (!out.why_not.empty()) return out;
    out.distance = lpips.distance(reference, test);
    return out;
}

LpipsMeasure lpips_measure(const std::string& weights, int width, int height) {
    if (weights.empty()) return {{}, kNoWeights};
    const auto lpips = std::make_shared<const Lpips>(weights);
    use_cpu_for_networks(1);  // its last digits depend on how many there are
    if (std::string why = too_small(*lpips, width, height); !why.empty()) return {{}, why};
    return {[lpips](const Image<SrgbF>& reference, const Image<SrgbF>& test) {
                return lpips->distance(reference, test);
            },
            {}};
}

}  // namespace verdigris::cli
