// SPDX-License-Identifier: MIT
// One function per subcommand, in path order. Each adds its options and says what to run.
#pragma once

#include <CLI/CLI.hpp>

#include "session.h"

namespace verdigris::cli {

void add_age(CLI::App& app, Session& session);
void add_inspect(CLI::App& app, Session& session);
void add_observe(CLI::App& app, Session& session);
void add_forecast(CLI::App& app, Session& session);
void add_materialize(CLI::App& app, Session& session);
void add_deliver(CLI::App& app, Session& session);
void add_view(CLI::App& app, Session& session);
void add_render(CLI::App& app, Session& session);
void add_simulate(CLI::App& app, Session& session);
void add_evaluate(CLI::App& app, Session& session);
void add_characterize(CLI::App& app, Session& session);
void add_drift(CLI::App& app, Session& session);
void add_judge_materials(CLI::App& app, Session& session);
void add_audit(CLI::App& app, Session& session);
void add_compare(CLI::App& app, Session& session);
void add_reproduce(CLI::App& app, Session& session);
void add_doctor(CLI::App& app, Session& session);

}  // namespace verdigris::cli
