// SPDX-License-Identifier: MIT
#include <memory>

#include "learned.h"
#include "verdigris/error.h"

namespace verdigris::cli {
namespace {

constexpr const char* kAbsent =
    "this build has no trained forecasters; `scripts/build_learn.sh` makes one that has (it "
    "installs libtorch, 550 MB)";

[[noreturn]] void absent() {
    throw Error(ErrorCode::usage, kAbsent);
}

void add(CLI::App& app, Session& session, const char* name, const char* what) {
    CLI::App* command = app.add_subcommand(name, what);
    command->allow_extras();
    session.add_options(*command);
    command->callback([&session] { session.action = [](Session&) { absent(); }; });
}

}  // namespace

bool is_checkpoint(const std::string& name) {
    return name.ends_with(".safetensors");
}

void add_learned_commands(CLI::App& app, Session& session) {
    add(app, session, "train", "Train a network on a recording (needs a build with libtorch)");
    add(app, session, "susceptibility",
        "What a network believes of a surface (needs a build with libtorch)");
    add(app, session, "study", "Studies of networks (needs a build with libtorch)");
}

std::string no_networks_because() {
    return kAbsent;
}

void check_checkpoints(const std::vector<std::string>& paths) {
    if (!paths.empty()) absent();
}

std::vector<Entrant> learned_entrants(const std::vector<std::string>& paths,
                                      const EvaluationProtocol&) {
    check_checkpoints(paths);
    return {};
}

LearnedForecaster learned_forecaster(const std::string&, const std::vector<double>&,
                                     const Observation&) {
    absent();
}

LpipsOutcome lpips_of(const std::string&, const std::string&, const Image<SrgbF>&,
                      const Image<SrgbF>&) {
    LpipsOutcome out;
    out.why_not = "this build has no libtorch; `scripts/build_learn.sh` makes one that has";
    return out;
}

LpipsMeasure lpips_measure(const std::string&, int, int) {
    return {{}, lpips_of({}, {}, {}, {}).why_not};
}

}  // namespace verdigris::cli
