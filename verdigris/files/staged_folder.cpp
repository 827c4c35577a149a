// SPDX-License-Identifier: MIT
#include "verdigris/files/staged_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/input_file.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".partial-";
// Where entries of the target wait inside the partial folder until the commit is complete.
constexpr const char* kReplaced = ".replaced";

[[noreturn]] void fail(const fs::path& folder, int error) {
    throw Error(ErrorCode::failed, "cannot be written: " + reason_from_errno(error),
                folder.string());
}

// The partial folders of this process. Without it a folder that an earlier process with our pid
// left behind (every container starts as the same pid) could not be told from a live one.
class LiveFolders {
  public:
    bool contains(const std::string& name) {
        const std::lock_guard lock(mutex_);
        return names_.contains(name);
    }
    void insert(const std::string& name) {
        const std::lock_guard lock(mutex_);
        names_.insert(name);
    }
    void erase(const std::string& name) {
        const std::lock_guard lock(mutex_);
        names_.erase(name);
    }

  private:
    std::mutex mutex_;
    std::set<std::string> names_;
};
LiveFolders& live_folders() {
    static LiveFolders folders;
    return folders;
}

// "<pid>-<n>" behind the prefix; anything else is not ours to remove.
bool is_stale(const std::string& name) {
    if (name.rfind(kPrefix, 0) != 0) return false;
    const char* const end = name.data() + name.size();
    pid_t pid = 0;
    const auto after_pid = std::from_chars(name.data() + kPrefix.size(), end, pid);
    if (after_pid.ec != std::errc() || pid <= 0 || after_pid.ptr == end || *after_pid.ptr != '-') {
        return false;
    }
    unsigned n = 0;
    const auto after_n = std::from_chars(after_pid.ptr + 1, end, n);
    if (after_n.ec != std::errc() || after_n.ptr != end) return false;
    if (pid == ::getpid()) return !live_folders().contains(name);
    return ::kill(pid, 0) != 0 && errno == ESRCH;
}

// Failing to clean up after somebody else is no reason to fail.
void remove_stale(const fs::path& target) {
    std::error_code error;
    std::vector<fs::path> stale;
    for (const auto& entry : fs::directory_iterator(target, error)) {
        if (is_stale(entry.path().filename().string())) stale.push_back(entry.path());
    }
    for (const fs::path& path : stale) fs::remove_all(path, error);
}

void sync_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

// Renames that can be taken back.
class Moves {
  public:
    void move(const fs::path& from, const fs::path& to, const fs::path& blame) {
        if (::rename(from.c_str(), to.c_str()) != 0) fail(blame, errno);
        done_.emplace_back(from, to);
    }
    void undo() {
        for (auto it = done_.rbegin(); it != done_.rend(); ++it) {
            ::rename(it->second.c_str(), it->first.c_str());
        }
    }

  private:
    std::vector<std::pair<fs::path, fs::path>> done_;
};

}  // namespace

StagedFolder::StagedFolder(std::filesystem::path target) : target_(std::move(target)) {
    if (target_.empty()) {
        throw Error(ErrorCode::failed, "cannot be written: the name of the folder is missing");
    }
    std::error_code error;
    const auto status = fs::status(target_, error);
    if (fs::exists(status) && !fs::is_directory(status)) {
        throw Error(ErrorCode::failed, "is a file, not a folder", target_.string());
    }
    created_target_ = !fs::exists(status);
    if (created_target_) {
        fs::create_directories(target_, error);
        if (error) fail(target_, error.value() == EEXIST ? ENOTDIR : error.value());
    }
    remove_stale(target_);
    static std::atomic<unsigned> counter{0};
    int problem = 0;
    do {
        const std::string name =
            std::string(kPrefix) + std::to_string(::getpid()) + "-" + std::to_string(++counter);
        partial_ = target_ / name;
        live_folders().insert(name);
        problem = ::mkdir(partial_.c_str(), 0777) == 0 ? 0 : errno;
        if (problem != 0) live_folders().erase(name);
    } while (problem == EEXIST);
    if (problem != 0) {
        if (created_target_) fs::remove(target_, error);
        fail(target_, problem);
    }
}

StagedFolder::~StagedFolder() {
    std::error_code ignored;
    fs::remove_all(partial_, ignored);
    live_folders().erase(partial_.filename().string());
    // Removes an empty folder only.
    if (!committed_ && created_target_) ::rmdir(target_.c_str());
}

void StagedFolder::commit(const std::string& last) {
    if (committed_) throw std::logic_error("StagedFolder::commit twice");
    std::error_code error;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(partial_, error)) {
        names.push_back(entry.path().filename().string());
    }
    if (error) fail(target_, error.value());
    std::sort(names.begin(), names.end());
    const auto position = std::find(names.begin(), names.end(), last);
    if (!last.empty() && position == names.end()) {
        throw std::logic_error("StagedFolder::commit: '" + last + "' was not made");
    }
    if (position != names.end()) std::rotate(position, position + 1, names.end());

    const fs::path replaced = partial_ / kReplaced;
    if (::mkdir(replaced.c_str(), 0777) != 0) fail(target_, errno);
    Moves moves;
    try {
        // The old manifest goes first and the new one comes last: at no moment does a manifest
        // vouch for a mixture.
        for (auto name = names.rbegin(); name != names.rend(); ++name) {
            if (fs::exists(fs::symlink_status(target_ / *name, error))) {
                moves.move(target_ / *name, replaced / *name, target_);
            }
        }
        for (const std::string& name : names) {
            moves.move(partial_ / name, target_ / name, target_);
        }
    } catch (...) {
        moves.undo();
        throw;
    }
    sync_folder(target_);
    committed_ = true;
    fs::remove_all(partial_, error);
}

}  // namespace verdigris
