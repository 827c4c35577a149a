// SPDX-License-Identifier: MIT
#include "verdigris/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/input_file.h"

namespace verdigris {
namespace {

[[noreturn]] void fail(const std::filesystem::path& target, int error) {
    throw Error(ErrorCode::failed, "cannot be written: " + reason_from_errno(error),
                target.string());
}

// A link is followed, so that it still is a link afterwards. Devices and pipes are refused: the
// rename would replace them.
std::filesystem::path resolved(const std::filesystem::path& target) {
    if (target.empty() || !target.has_filename()) {
        throw Error(ErrorCode::failed, "cannot be written: the name is missing", target.string());
    }
    std::error_code ignored;
    std::filesystem::path path = target;
    if (std::filesystem::is_symlink(path, ignored)) {
        const auto followed = std::filesystem::weakly_canonical(path, ignored);
        if (!followed.empty() && !std::filesystem::is_symlink(followed, ignored)) path = followed;
    }
    const auto status = std::filesystem::status(path, ignored);
    if (std::filesystem::is_directory(status)) fail(target, EISDIR);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw Error(ErrorCode::failed, "cannot be written: it is not a regular file",
                    target.string());
    }
    return path;
}

// 200 bytes of the name leave room for pid and counter in the usual limit of 255.
std::string temporary_prefix(const std::filesystem::path& target) {
    return "." + target.filename().string().substr(0, 200) + ".";
}

std::filesystem::path temporary_name(const std::filesystem::path& target) {
    static std::atomic<unsigned> counter{0};
    return target.parent_path() / (temporary_prefix(target) + std::to_string(::getpid()) + "-" +
                                   std::to_string(++counter) + ".tmp");
}

// The pid and the counter of temporary_name().
bool is_pid_and_counter(std::string_view text) {
    const std::size_t dash = text.find('-');
    const auto number = [](std::string_view t) {
        return !t.empty() && t.find_first_not_of("0123456789") == std::string_view::npos;
    };
    return dash != std::string_view::npos && number(text.substr(0, dash)) &&
           number(text.substr(dash + 1));
}

// The rename is on disk only when its folder is. Some file systems cannot sync a folder; the file
// is complete all the same, so that is no error.
void sync_folder(const std::filesystem::path& folder) {
    const int descriptor =
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
    const std::filesystem::path path = resolved(target_);
    if (path.has_parent_path()) {
        std::error_code error;
        std::filesystem::create_directories(path.parent_path(), error);
        // EEXIST: a file stands where a folder is needed.
        if (error) fail(target_, error.value() == EEXIST ? ENOTDIR : error.value());
    }
    do {
        temporary_ = temporary_name(path);
        // 0666: the user's umask decides, as for any other file.
        descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && (errno == EEXIST || errno == EINTR));
    if (descriptor_ < 0) fail(target_, errno);
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    if (descriptor_ < 0) throw std::logic_error("AtomicFile::write after commit");
    while (!bytes.empty()) {
        // 1 GiB at a time: Linux transfers at most 2 GiB in one call.
        const ssize_t done =
            ::write(descriptor_, bytes.data(), std::min(bytes.size(), std::size_t(1) << 30));
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) fail(target_, done < 0 ? errno : ENOSPC);
        bytes = bytes.subspan(std::size_t(done));
    }
}

void AtomicFile::write(std::string_view text) {
    write(std::as_bytes(std::span(text.data(), text.size())));
}

void AtomicFile::rewrite(std::size_t offset, std::span<const std::byte> bytes) {
    if (descriptor_ < 0) throw std::logic_error("AtomicFile::rewrite after commit");
    const off_t end = ::lseek(descriptor_, 0, SEEK_CUR);
    if (end < 0) fail(target_, errno);
    if (offset > std::size_t(end) || bytes.size() > std::size_t(end) - offset) {
        throw std::out_of_range("AtomicFile::rewrite beyond what was written");
    }
    while (!bytes.empty()) {
        const ssize_t done = ::pwrite(descriptor_, bytes.data(),
                                      std::min(bytes.size(), std::size_t(1) << 30), off_t(offset));
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) fail(target_, done < 0 ? errno : ENOSPC);
        bytes = bytes.subspan(std::size_t(done));
        offset += std::size_t(done);
    }
}

void AtomicFile::commit() {
    if (descriptor_ < 0) throw std::logic_error("AtomicFile::commit twice");
    // EINVAL: a file system without sync. Everything else means that bytes may be missing.
    if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(target_, errno);
    const int descriptor = std::exchange(descriptor_, -1);
    // A network file system may report a full disk only here.
    if (::close(descriptor) != 0 && errno != EINTR) fail(target_, errno);
    const std::filesystem::path path = resolved(target_);
    if (::rename(temporary_.c_str(), path.c_str()) != 0) fail(target_, errno);
    committed_ = true;
    sync_folder(path.parent_path());
}

void write_file(const std::filesystem::path& target, std::span<const std::byte> bytes) {
    AtomicFile file(target);
    file.write(bytes);
    file.commit();
}

void write_file(const std::filesystem::path& target, std::string_view text) {
    write_file(target, std::as_bytes(std::span(text.data(), text.size())));
}

namespace {

template <class Container>
Container read_whole(const std::filesystem::path& path, std::size_t limit) {
    InputFile file(path);
    if (file.size() > limit) {
        file.refuse("is too large: " + std::to_string(file.size()) + " bytes, the limit is " +
                    std::to_string(limit));
    }
    Container content;
    content.resize(std::size_t(file.size()));
    const auto got = file.read(std::as_writable_bytes(std::span(content)));
    if (got < content.size()) file.refuse("became shorter while it was read");
    return content;
}

}  // namespace

void remove_abandoned(const std::filesystem::path& target) {
    constexpr std::string_view kEnding = ".tmp";
    const std::string prefix = temporary_prefix(target);
    const auto folder =
        target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
    std::vector<std::filesystem::path> left;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string whole = entry->path().filename().string();
        std::string_view name = whole;
        if (!name.starts_with(prefix) || !name.ends_with(kEnding)) continue;
        name.remove_prefix(prefix.size());
        name.remove_suffix(std::min(name.size(), kEnding.size()));
        if (is_pid_and_counter(name)) left.push_back(entry->path());
    }
    for (const auto& path : left) std::filesystem::remove(path, error);
}

std::vector<std::byte> read_file(const std::filesystem::path& path, std::size_t limit) {
    return read_whole<std::vector<std::byte>>(path, limit);
}

std::string read_text(const std::filesystem::path& path, std::size_t limit) {
    return read_whole<std::string>(path, limit);
}

}  // namespace verdigris
