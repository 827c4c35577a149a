// SPDX-License-Identifier: MIT
// Command-line arguments shared by `age` and the stage commands, filled straight into the
// library's own option structs.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/forecast/choose.h"
#include "verdigris/material/material.h"
#include "verdigris/observe/observe.h"

namespace verdigris::cli {

/// Stage 1.
struct ObserveArguments {
    std::string crop = "auto", size = "native";
    double units = 0, tau = 0;  ///< 0: measured
    std::string assume_matrix, assume_range;
    bool every_sample = false;

    void add(CLI::App& command);
    /// Throws Error{usage} quoting what was typed.
    ObserveOptions options() const;
    RecordingOptions recording_options() const;
};

/// Stage 2.
struct ForecastArguments {
    int context = 10;
    std::vector<double> horizons{5, 10, 20, 50};
    std::string forecaster = "auto", fit_pixels = "all";
    double ridge_k = 30;
    bool no_clamp = false;

    void add(CLI::App& command);
    ChooseOptions options() const;
    /// Increasing, without repeats. Throws Error{usage}.
    std::vector<double> sorted_horizons() const;
};

/// Stage 3: every constant of the material, with the paper's value as default.
struct MaterialArguments {
    MaterialOptions options;
    std::string clean_state = "auto";  ///< auto, context or start
    void add(CLI::App& command);
    void check() const;  ///< throws Error{usage}
};

}  // namespace verdigris::cli
