// SPDX-License-Identifier: MIT
// The files of a result, listed with their SHA-256: so that an audit sees what was changed since,
// and nobody's own file is taken for ours.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "verdigris/status.h"

namespace verdigris {

/// The list's name in a result folder: "SHA256SUMS", as `sha256sum --check` reads it.
inline constexpr const char* kFileList = "SHA256SUMS";

/// Path relative to the folder, "/" between names -> SHA-256 in hexadecimal.
using FileList = std::map<std::string, std::string>;

/// Lists every regular file in `folder` and below and writes the list there. Cost: reads them all.
/// Throws Error{failed}: what cannot be read or written.
void write_file_list(const std::filesystem::path& folder);

/// Empty if there is no list. Throws Error{bad_input} naming the line that is none of ours.
FileList read_file_list(const std::filesystem::path& folder);

/// What differs from the list, one finding each. Refusals: "file_list_missing", "file_missing",
/// "file_changed", "file_list_incomplete" where a name in `always` is not listed, "file_added" for
/// one in tables/ or figures/, where only ours are; an info: "file_not_listed", with the first of
/// them. A list vouches against
/// accidents: who changes a file on purpose can change the list. Throws as read_file_list.
Statuses check_file_list(const std::filesystem::path& folder,
                         const std::vector<std::string>& always = {});

/// The first file below `folder`/`entry` that the list does not name (`entry` itself, if it is a
/// file); empty if there is none.
std::string unlisted_file(const std::filesystem::path& folder, const std::string& entry,
                          const FileList& list);

/// Removes from `folder` what `before` lists, its list no longer names, and nobody has changed: of
/// a result that was replaced by one with fewer files.
void remove_left_over(const std::filesystem::path& folder, const FileList& before);

}  // namespace verdigris
