// SPDX-License-Identifier: MIT
// A folder for one process at a time.
#pragma once

#include <filesystem>
#include <string>

namespace verdigris {

/// Makes the folder and keeps it for one process; gone with the process, however it ends.
/// Throws Error{refused} where another one has it ("is being <doing> by another process");
/// Error{failed} where it cannot be made. File systems without locks let everybody in.
class FolderLock {
  public:
    FolderLock(const std::filesystem::path& folder, const std::string& doing);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int descriptor_;
};

}  // namespace verdigris
