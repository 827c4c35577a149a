// SPDX-License-Identifier: MIT
#include "verdigris/files/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "verdigris/error.h"

namespace verdigris {

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& doing) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw Error(ErrorCode::failed, "cannot be made: " + error.message(), folder.string());
    descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
        return;
    ::close(descriptor_);
    throw Error(ErrorCode::refused,
                "is being " + doing + " by another process; choose another folder",
                folder.string());
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace verdigris
