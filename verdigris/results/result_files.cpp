// SPDX-License-Identifier: MIT
#include "verdigris/results/result_files.h"

#include <fmt/format.h>

#include <string_view>
#include <system_error>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/sha256.h"

namespace verdigris {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kDigits = 64;

/// What is no regular file is not listed: a result holds none, and following links leads elsewhere.
std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (auto it = fs::recursive_directory_iterator(folder, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        const std::string name = it->path().lexically_relative(folder).generic_string();
        // A run that is writing now, or died: not part of any result.
        if (name.starts_with(".partial-")) {
            it.disable_recursion_pending();
        } else if (it->is_regular_file(error) && !it->is_symlink(error) && name != kFileList) {
            names.push_back(name);
        }
    }
    if (error)
        throw Error(ErrorCode::failed, "cannot be read: " + error.message(), folder.string());
    return names;
}

bool is_regular(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(fs::symlink_status(path, error));
}

/// A list may only speak of what is in its folder.
bool stays_inside(const fs::path& name) {
    if (name.empty() || name.is_absolute()) return false;
    for (const fs::path& part : name)
        if (part == ".." || part == ".") return false;
    return true;
}

}  // namespace

void write_file_list(const fs::path& folder) {
    FileList sorted;
    for (const std::string& name : files_below(folder))
        sorted[name] = sha256_of_file(folder / name);
    std::string text;
    for (const auto& [name, sum] : sorted) text += fmt::format("{}  {}\n", sum, name);
    write_file(folder / kFileList, text);
}

FileList read_file_list(const fs::path& folder) {
    FileList list;
    const fs::path path = folder / kFileList;
    if (!is_regular(path)) return list;
    const std::string text = read_text(path, 1 << 20);
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = std::string_view(text).substr(begin, end - begin);
        begin = end + 1;
        ++number;
        const bool ours = line.size() > kDigits + 2 && line.substr(kDigits, 2) == "  " &&
                          line.find_first_not_of("0123456789abcdef") == kDigits &&
                          stays_inside(fs::path(line.substr(kDigits + 2)));
        if (!ours)
            throw Error(ErrorCode::bad_input, "is not '<sha256>  <file>'",
                        fmt::format("{}, line {}", path.string(), number));
        list.emplace(line.substr(kDigits + 2), line.substr(0, kDigits));
    }
    return list;
}

Statuses check_file_list(const fs::path& folder, const std::vector<std::string>& always) {
    Statuses findings;
    const FileList list = read_file_list(folder);
    if (list.empty()) {
        findings.push_back({"file_list_missing", Severity::refusal,
                            fmt::format("there is no {}, so that nobody can say whether the files "
                                        "are those that were delivered",
                                        kFileList)});
        return findings;
    }
    for (const auto& [name, sum] : list) {
        if (!is_regular(folder / name)) {
            findings.push_back(
                {"file_missing", Severity::refusal, fmt::format("{} is missing", name)});
        } else if (sha256_of_file(folder / name) != sum) {
            findings.push_back({"file_changed", Severity::refusal,
                                fmt::format("{} is not the file that was delivered", name)});
        }
    }
    for (const std::string& name : always) {
        if (!list.contains(name))
            findings.push_back({"file_list_incomplete", Severity::refusal,
                                fmt::format("{} is not in {}, though every result of this kind "
                                            "has it",
                                            name, kFileList)});
    }
    std::string first;
    int own = 0;
    for (const std::string& name : files_below(folder)) {
        if (list.contains(name)) continue;
        if (name.starts_with("tables/") || name.starts_with("figures/")) {
            findings.push_back({"file_added", Severity::refusal,
                                fmt::format("{} was not delivered with this result", name)});
            continue;
        }
        if (own++ == 0 || name < first) first = name;
    }
    if (own > 0)
        findings.push_back(
            {"file_not_listed", Severity::info,
             fmt::format("{} file{} part of this result, {}{}", own,
                         own == 1 ? " is no" : "s are no", own == 1 ? "" : "the first ", first)});
    return findings;
}

std::string unlisted_file(const fs::path& folder, const std::string& entry, const FileList& list) {
    std::error_code error;
    const auto status = fs::symlink_status(folder / entry, error);
    if (!fs::exists(status)) return {};
    if (!fs::is_directory(status)) return list.contains(entry) ? "" : entry;
    std::string first;
    for (const auto& inside : fs::recursive_directory_iterator(folder / entry, error)) {
        if (inside.is_directory(error) && !inside.is_symlink(error)) continue;
        const std::string name = inside.path().lexically_relative(folder).generic_string();
        if (!list.contains(name) && (first.empty() || name < first)) first = name;
    }
    return first;
}

void remove_left_over(const fs::path& folder, const FileList& before) {
    const FileList now = read_file_list(folder);
    std::error_code ignored;
    for (const auto& [name, sum] : before) {
        if (now.contains(name) || !is_regular(folder / name)) continue;
        if (sha256_of_file(folder / name) != sum) continue;
        fs::remove(folder / name, ignored);
        // The folder it was in, if that is empty now.
        const fs::path parent = fs::path(name).parent_path();
        if (!parent.empty() && fs::is_empty(folder / parent, ignored))
            fs::remove(folder / parent, ignored);
    }
}

}  // namespace verdigris
