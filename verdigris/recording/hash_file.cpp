// SPDX-License-Identifier: MIT
#include "verdigris/recording/hash_file.h"

#include <cstddef>
#include <fstream>
#include <span>
#include <vector>

#include "verdigris/error.h"

namespace verdigris {

void hash_file(Sha256& hash, const std::filesystem::path& path, HashProgress& progress) {
    std::ifstream in(path, std::ios::binary);
    // chosen: 1 MiB, a few milliseconds of hashing between two looks at the progress callback.
    std::vector<char> block(std::size_t(1) << 20);
    while (in) {
        in.read(block.data(), std::streamsize(block.size()));
        const std::size_t got = std::size_t(in.gcount());
        hash.update(std::as_bytes(std::span<const char>(block.data(), got)));
        progress.done += std::int64_t(got);
        report(progress.progress, "hash", progress.done, progress.total);
    }
    if (!in.eof()) throw Error(ErrorCode::bad_input, "cannot be read", path.string());
}

}  // namespace verdigris
