// SPDX-License-Identifier: MIT
// Does what a network believes of a surface hold on another surface? The paper's Figure 5.
#include <fmt/format.h>

#include <cmath>

#include "judged.h"
#include "learned_commands.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/csv.h"
#include "verdigris/learn/susceptibility.h"
#include "verdigris/results/protocol_file.h"
#include "verdigris/results/susceptibility_report.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

struct Arguments {
    JudgeArguments judge;
    std::string run;
};

}  // namespace
}  // namespace verdigris::cli
