// SPDX-License-Identifier: MIT
// What the tests of this room and of those above it share: a folder that goes away, and errors as
// values.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

#include "verdigris/error.h"

namespace verdigris {

/// A fresh folder below the system's temporary folder, removed with everything in it.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name =
            (std::filesystem::temp_directory_path() / "verdigris-test-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

/// A file without the care of AtomicFile, for loops over hundreds of broken files. Overwritten in
/// place: file systems flush what is truncated to nothing and written again.
inline void put_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    const bool written = ::write(descriptor, bytes.data(), bytes.size()) == ssize_t(bytes.size()) &&
                         ::ftruncate(descriptor, off_t(bytes.size())) == 0;
    if (::close(descriptor) != 0 || !written) throw std::runtime_error("no temporary file");
}

/// Number of entries in a folder, hidden ones included.
inline int entry_count(const std::filesystem::path& folder) {
    int count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
    return count;
}

/// The Error that `body` throws; a test failure if it throws none.
template <class Body>
Error error_of(Body body) {
    try {
        body();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "no Error was thrown";
    return Error(ErrorCode::usage, "no Error was thrown");
}

/// While it lives the process has no right to write where only root may. Tests run as root in
/// containers, where permissions would otherwise not be checked at all.
class AsNobody {
  public:
    AsNobody() : was_root_(::geteuid() == 0) {
        if (was_root_ && ::seteuid(65534) != 0) throw std::runtime_error("seteuid failed");
    }
    ~AsNobody() {
        if (was_root_ && ::seteuid(0) != 0) std::abort();
    }
    AsNobody(const AsNobody&) = delete;
    AsNobody& operator=(const AsNobody&) = delete;

  private:
    bool was_root_;
};

}  // namespace verdigris
