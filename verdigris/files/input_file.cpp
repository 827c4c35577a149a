// SPDX-License-Identifier: MIT
#include "verdigris/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace verdigris {

std::string reason_from_errno(int error) {
    switch (error) {
        case ENOSPC:
            return "the disk is full";
        case EDQUOT:
            return "the disk quota is used up";
        case EFBIG:
            return "the file is larger than the system allows";
        case EROFS:
            return "the file system is read-only";
        case EACCES:
        case EPERM:
            return "no permission";
        case ENOENT:
            return "it does not exist";
        case ENOTDIR:
            return "a part of the path is a file, not a folder";
        case EISDIR:
            return "it is a folder";
        case ENAMETOOLONG:
            return "the name is too long";
        case EMFILE:
        case ENFILE:
            return "too many files are open";
        case EIO:
            return "the disk reports an input/output error";
        default:
            return std::generic_category().message(error);
    }
}

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
    // O_NONBLOCK: opening a FIFO must not hang before it is found to be one.
    const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        const int error = errno;
        if (error == ENOENT) refuse("does not exist");
        refuse("cannot be opened: " + reason_from_errno(error));
    }
    struct stat status {};
    const bool known = ::fstat(descriptor, &status) == 0;
    if (!known || !S_ISREG(status.st_mode)) {
        const bool folder = known && S_ISDIR(status.st_mode);
        ::close(descriptor);
        refuse(folder ? "is a folder, not a file" : "is not a regular file");
    }
    file_.reset(::fdopen(descriptor, "rb"));
    if (!file_) {
        ::close(descriptor);
        refuse("cannot be opened: " + reason_from_errno(ENOMEM));
    }
    size_ = std::uint64_t(status.st_size);
}

std::size_t InputFile::read(std::span<std::byte> bytes) {
    const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), file_.get());
    if (got < bytes.size() && std::ferror(file_.get())) {
        refuse("cannot be read: " + reason_from_errno(errno));
    }
    return got;
}

void InputFile::seek(std::uint64_t offset) {
    if (::fseeko(file_.get(), off_t(offset), SEEK_SET) != 0) {
        refuse("cannot be read: " + reason_from_errno(errno));
    }
}

void InputFile::refuse(const std::string& sentence) const {
    throw Error(ErrorCode::bad_input, sentence, path_.string());
}

}  // namespace verdigris
