// SPDX-License-Identifier: MIT
// Has a file or a folder changed since?
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace verdigris {

struct Fingerprint {
    /// Of names, sizes and times of change: where it is the same as before, the bytes are taken to
    /// be, as make and git take it.
    std::string stamp;
    /// Of names and bytes.
    std::string content;
};

/// Of a file, or of every regular file in a folder and below; hidden ones (what a run that writes
/// or died leaves) do not count. `known`: where the stamp is its, so is the content, and nothing is
/// read. Throws Error{bad_input}: what is not there or cannot be read. Cost: reads it all.
Fingerprint fingerprint(const std::filesystem::path& path,
                        const std::optional<Fingerprint>& known = {});

}  // namespace verdigris
