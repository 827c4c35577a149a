// SPDX-License-Identifier: MIT
// What every subcommand shares: how it talks (stdout for results, stderr for talk), how it is
// interrupted, and which action was chosen on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "stage_clock.h"
#include "verdigris/progress.h"
#include "verdigris/status.h"

namespace verdigris::cli {

using Json = nlohmann::ordered_json;

/// Draws one bar on a terminal, or a plain line every ten seconds elsewhere. Both with an ETA.
class ProgressPrinter {
  public:
    explicit ProgressPrinter(bool silent);
    /// False once the user asked to stop.
    bool operator()(std::string_view stage, std::int64_t done, std::int64_t total);
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    bool silent_, terminal_, drawn_ = false;
    StageClock stages_;
    Clock::time_point start_, last_print_;
};

class Session {
  public:
    bool json = false, quiet = false, force = false;
    int threads = 0;
    /// Set by the chosen subcommand; run by main after parsing, so that its errors are not
    /// mistaken for usage errors.
    std::function<void(Session&)> action;

    /// --json, --quiet, --threads: the same for every subcommand.
    void add_options(CLI::App& command);
    Progress progress();
    /// A line for people on stdout; nothing with --json or --quiet.
    void say(const std::string& line);
    /// Cautions and refusals on stderr (not with --quiet), infos as say().
    void tell(const Status& status);
    /// The result: one JSON object on stdout with --json.
    void result(const Json& object);

  private:
    std::shared_ptr<ProgressPrinter> printer_;
};

/// A finding as a sentence of its own: the library's notes begin in lower case, to follow "file: ".
std::string as_sentence(const std::string& note);

/// Installs handlers for SIGINT, SIGTERM and SIGHUP: the next progress report then stops the work.
void catch_interrupts();
bool interrupted();

}  // namespace verdigris::cli
