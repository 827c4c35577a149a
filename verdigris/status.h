// SPDX-License-Identifier: MIT
// How the library says that the data are weak. A status rides in the result; the user is told in
// the sentence. Nothing is thrown.
#pragma once

#include <string>
#include <vector>

namespace verdigris {

enum class Severity {
    info,     ///< worth knowing
    caution,  ///< the result may mislead; the sentence says how
    refusal,  ///< the result should not be used unless the user insists (--force)
};

/// One finding about the data, or one guard that fired.
struct Status {
    std::string id;        ///< stable, for scripts: "few_frames", "color_reversal", "broken_tail"
    Severity severity{};   ///< how much it matters
    std::string sentence;  ///< for the user: what, where, and what to do about it
};

using Statuses = std::vector<Status>;

}  // namespace verdigris
