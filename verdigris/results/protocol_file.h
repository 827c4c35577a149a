// SPDX-License-Identifier: MIT
// The protocol, and blocks of one's own, as TOML files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/evaluate/protocol.h"

namespace verdigris {

/// Keys are the names of EvaluationProtocol's fields; what is missing keeps the default.
/// Throws Error{bad_input} with one sentence that names file, line, key and what is allowed.
EvaluationProtocol read_protocol(const std::filesystem::path& path);
/// Every key with its value and its meaning; reading it gives the same protocol.
std::string protocol_text(const EvaluationProtocol& protocol);

/// A named span of a recording, for gains of its own: windows whose first sample lies in it.
struct NamedBlock {
    std::string recording, name;
    double begin = 0, end = 0;  ///< units from the start of the recording, [begin, end)
};
/// [recording] sections with name = [begin, end]. Throws as read_protocol; blocks of one recording
/// may not overlap.
std::vector<NamedBlock> read_blocks(const std::filesystem::path& path);

}  // namespace verdigris
