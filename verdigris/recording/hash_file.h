// SPDX-License-Identifier: MIT
// Hashing files of any size with a progress that runs over all of them. Internal.
#pragma once

#include <cstdint>
#include <filesystem>

#include "verdigris/files/sha256.h"
#include "verdigris/progress.h"

namespace verdigris {

/// Stage "hash", in bytes.
struct HashProgress {
    const Progress& progress;
    std::int64_t done = 0, total = 0;
};

/// Streams `path` into `hash`. Throws Error{bad_input} if it cannot be read.
void hash_file(Sha256& hash, const std::filesystem::path& path, HashProgress& progress);

}  // namespace verdigris
