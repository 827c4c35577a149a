// SPDX-License-Identifier: MIT
// Written whole or not at all: a temporary name beside the target, fsync, rename.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace verdigris {

/// A file under construction. Until commit() the target is untouched; if the object dies before,
/// the temporary is removed. Creates missing parent folders.
/// Throws Error{failed} naming the target: no permission, disk full (the sentence says which).
class AtomicFile {
  public:
    explicit AtomicFile(std::filesystem::path target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    /// Overwrites `bytes` at `offset`, which must lie in what was already written: for headers
    /// whose counts are known last.
    void rewrite(std::size_t offset, std::span<const std::byte> bytes);
    /// fsync, then rename onto the target.
    void commit();

    const std::filesystem::path& target() const { return target_; }
    /// Where the bytes are until commit(), for codecs that insist on opening a path themselves.
    const std::filesystem::path& temporary() const { return temporary_; }

  private:
    std::filesystem::path target_, temporary_;
    int descriptor_ = -1;
    bool committed_ = false;
};

/// AtomicFile in one call.
void write_file(const std::filesystem::path& target, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& target, std::string_view text);

/// Removes the temporaries of `target` that killed processes left beside it. Only where nobody else
/// can be writing `target`, as in a folder that is locked. What cannot be removed stays.
void remove_abandoned(const std::filesystem::path& target);

/// The whole file. Throws Error{bad_input}: missing, unreadable, a folder, or over `limit` bytes.
std::vector<std::byte> read_file(const std::filesystem::path& path,
                                 std::size_t limit = std::size_t(1) << 31);
std::string read_text(const std::filesystem::path& path, std::size_t limit = std::size_t(1) << 26);

}  // namespace verdigris
