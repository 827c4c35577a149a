// SPDX-License-Identifier: MIT
// How the library says that the data are weak. A status rides in the result; the user is told in
// the sentence. Nothing is thrown.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace verdigris {

enum class Severity {
    info,     ///< worth knowing
    caution,  ///< the result may mislead; the sentence says how
    refusal,  ///< the result should not be used unless the user insists (--force)
};

/// "info", "caution", "refusal": in every JSON that a status is written to.
inline std::string to_string(Severity severity) {
    switch (severity) {
        case Severity::info:
            return "info";
        case Severity::caution:
            return "caution";
        case Severity::refusal:
            return "refusal";
    }
    return "info";
}
/// The inverse; nothing for any other name.
inline std::optional<Severity> severity_from(std::string_view name) {
    for (const Severity s : std::array{Severity::info, Severity::caution, Severity::refusal}) {
        if (to_string(s) == name) return s;
    }
    return std::nullopt;
}

/// One finding about the data, or one guard that fired.
struct Status {
    std::string id;        ///< stable, for scripts: "few_frames", "color_reversal", "broken_tail"
    Severity severity{};   ///< how much it matters
    std::string sentence;  ///< for the user: what, where, and what to do about it
};

using Statuses = std::vector<Status>;

}  // namespace verdigris
