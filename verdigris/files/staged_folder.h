// SPDX-License-Identifier: MIT
// A result folder that changes all at once: a stage writes into a hidden folder inside the
// target, and commit() moves the finished entries into place.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace verdigris {

/// While it lives, `path()` is a fresh folder `<target>/.partial-<pid>-<n>` on the same file
/// system. commit() replaces each top-level entry of the target that has a namesake in path() and
/// leaves the others alone. If the object dies before, the partial folder is removed and the
/// target is as it was (and is removed too if it did not exist before and is empty).
/// Stale partial folders of dead processes are removed on construction.
/// Throws Error{failed} naming the folder: not a folder, no permission, disk full.
class StagedFolder {
  public:
    explicit StagedFolder(std::filesystem::path target);
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    const std::filesystem::path& target() const { return target_; }
    const std::filesystem::path& path() const { return partial_; }
    /// Moves every entry of path() into the target. `last` names the entry that moves last (the
    /// manifest): whoever sees it sees the rest.
    void commit(const std::string& last = {});

  private:
    std::filesystem::path target_, partial_;
    bool created_target_ = false, committed_ = false;
};

}  // namespace verdigris
