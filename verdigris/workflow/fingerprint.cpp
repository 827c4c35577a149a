// SPDX-License-Identifier: MIT
#include "verdigris/workflow/fingerprint.h"

#include <sys/stat.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/sha256.h"

namespace verdigris {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> files_of(const fs::path& path) {
    std::error_code error;
    const auto status = fs::status(path, error);
    if (!fs::exists(status)) throw Error(ErrorCode::bad_input, "is not there", path.string());
    if (!fs::is_directory(status)) return {path};
    std::vector<fs::path> files;
    for (auto it = fs::recursive_directory_iterator(path, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        const bool hidden = it->path().filename().string().starts_with(".");
        if (hidden && it->is_directory(error)) it.disable_recursion_pending();
        if (!hidden && it->is_regular_file(error)) files.push_back(it->path());
    }
    if (error)
        throw Error(ErrorCode::bad_input, "cannot be read: " + error.message(), path.string());
    std::ranges::sort(files);
    return files;
}

}  // namespace

Fingerprint fingerprint(const fs::path& path, const std::optional<Fingerprint>& known) {
    const std::vector<fs::path> files = files_of(path);
    Sha256 stamp;
    for (const fs::path& file : files) {
        struct stat info {};
        if (::stat(file.c_str(), &info) != 0)
            throw Error(ErrorCode::bad_input, "cannot be read", file.string());
        // The length keeps a name apart from what follows it.
        const std::string name = file.lexically_relative(path).generic_string();
        stamp.update(std::to_string(name.size()) + ":" + name + " " + std::to_string(info.st_size) +
                     " " + std::to_string(info.st_mtim.tv_sec) + "." +
                     std::to_string(info.st_mtim.tv_nsec) + " " + std::to_string(info.st_ino) +
                     "\n");
    }
    Fingerprint print{stamp.hex(), {}};
    if (known && known->stamp == print.stamp) return *known;
    Sha256 content;
    for (const fs::path& file : files) {
        const std::string name = file.lexically_relative(path).generic_string();
        content.update(std::to_string(name.size()) + ":" + name + " " + sha256_of_file(file) +
                       "\n");
    }
    print.content = content.hex();
    return print;
}

}  // namespace verdigris
