// SPDX-License-Identifier: MIT
// Every key of a spec file, once: what it is called, what it may be, what it means. Reading,
// writing, checking and documenting all go over this list.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "verdigris/simulate/spec.h"

namespace verdigris {

/// One of a few words.
struct SpecChoice {
    std::vector<std::string_view> words;
    std::function<int()> get;
    std::function<void(int)> set;
};
/// Where the value lives in the spec that the list was made for.
using SpecValue = std::variant<double*, int*, std::uint64_t*, bool*, std::array<double, 3>*,
                               std::filesystem::path*, SpecChoice>;

struct SpecField {
    std::string_view section, key;  ///< section "" for the top of the file
    SpecValue value;
    double least = 0, most = 0;  ///< inclusive; of every number of an array
    std::string_view meaning;    ///< with its unit

    std::string name() const {
        return section.empty() ? std::string(key) : std::string(section) + "." + std::string(key);
    }
};

/// In the order in which a spec file is written. Pointers into `spec`.
std::vector<SpecField> spec_fields(SimulationSpec& spec);

/// "0 to 5000", "true or false", "gaussian or reaction_diffusion": what a field may be.
std::string allowed(const SpecField& field);
/// "oxide.initial_nm is -3; allowed are 0 to 5000"; empty if the value is allowed.
std::string complaint(const SpecField& field);

}  // namespace verdigris
