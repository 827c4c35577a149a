// SPDX-License-Identifier: MIT
// The subcommands that need libtorch.
#pragma once

#include <CLI/CLI.hpp>

#include "session.h"

namespace verdigris::cli {

void add_train(CLI::App& app, Session& session);
void add_susceptibility(CLI::App& app, Session& session);
void add_study(CLI::App& app, Session& session);

}  // namespace verdigris::cli
