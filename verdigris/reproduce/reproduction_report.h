// SPDX-License-Identifier: MIT
// The paper's tables and figures, each beside what came out here.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "verdigris/report/page.h"
#include "verdigris/reproduce/reproduced.h"

namespace verdigris {

/// Reads the results of the tasks that are there; of the others it says why they are not. Every
/// sentence that compares follows from the values. Throws nothing for a result that is missing or
/// damaged: it stands as n/a.
Report reproduction_report(const Reproduced& reproduced);

/// Per task: state, sentence, command, seconds.
Table task_table(const Reproduced& reproduced);
nlohmann::ordered_json json_of(const Reproduced& reproduced);

}  // namespace verdigris
