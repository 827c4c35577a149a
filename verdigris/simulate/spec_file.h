// SPDX-License-Identifier: MIT
// A specimen as a TOML file: `preset` names what to start from, every other key changes one number.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "verdigris/simulate/spec.h"

namespace verdigris {

/// `preset` of the file, or `fallback` if it has none, with the file's keys put over it. Names of
/// tables count from the file's folder. Throws Error{bad_input} with one sentence that names file,
/// line, key and what is allowed: not TOML, a key that is not known (with the nearest one that is),
/// a value of another type or out of range, an optical table that cannot be read.
SimulationSpec read_spec(const std::filesystem::path& path, const std::string& fallback);

/// Every key with its value, its meaning and its range: reading it gives the same spec, whatever
/// becomes of the presets.
std::string spec_text(const SimulationSpec& spec);

}  // namespace verdigris
