// SPDX-License-Identifier: MIT
// A file opened for reading, with one clear sentence for each way in which that can fail.
// Used inside this room only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "verdigris/error.h"

namespace verdigris {

/// What errno says, for a person: "the disk is full", "no permission".
std::string reason_from_errno(int error);

/// Buffered, seekable, regular. The codecs read through it, so that headers cost headers only.
class InputFile {
  public:
    /// Throws Error{bad_input}: missing, a folder, not a regular file, no permission.
    explicit InputFile(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t size() const { return size_; }
    std::FILE* handle() const { return file_.get(); }

    /// Fills as much of `bytes` as the file holds from here on. Throws on a read error.
    std::size_t read(std::span<std::byte> bytes);
    void seek(std::uint64_t offset);

    /// Throws Error{bad_input} about this file.
    [[noreturn]] void refuse(const std::string& sentence) const;

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::uint64_t size_ = 0;
};

}  // namespace verdigris
