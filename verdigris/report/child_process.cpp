// SPDX-License-Identifier: MIT
#include "verdigris/report/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string_view>
#include <thread>

#include "verdigris/error.h"

namespace verdigris {
namespace {

[[noreturn]] void fail(const ProcessCall& call, const std::string& what) {
    throw Error(ErrorCode::failed, what, call.program.filename().string());
}

// A file without a name, in memory. Unlike a pipe it takes any amount while nobody reads, so that
// neither side can wait for the other, and a child that stops reading raises no SIGPIPE here.
class MemoryFile {
  public:
    explicit MemoryFile(const ProcessCall& call)
        : descriptor_(::memfd_create("verdigris", MFD_CLOEXEC)) {
        if (descriptor_ < 0) fail(call, std::string("cannot be run: ") + std::strerror(errno));
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    int descriptor() const { return descriptor_; }

    bool fill(std::string_view text) {
        while (!text.empty()) {
            const ssize_t n = ::write(descriptor_, text.data(), text.size());
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) return false;
            text.remove_prefix(std::size_t(n));
        }
        return ::lseek(descriptor_, 0, SEEK_SET) == 0;
    }
    std::string all() const {
        struct stat info {};
        if (::fstat(descriptor_, &info) != 0) return {};
        std::string text(std::size_t(info.st_size), '\0');
        std::size_t done = 0;
        while (done < text.size()) {
            const ssize_t n =
                ::pread(descriptor_, text.data() + done, text.size() - done, off_t(done));
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) break;
            done += std::size_t(n);
        }
        text.resize(done);
        return text;
    }

  private:
    int descriptor_;
};

// The caller's environment, but for the locale: decimal commas would be read as separators.
std::vector<std::string> environment() {
    std::vector<std::string> out{"LC_ALL=C.UTF-8"};
    for (char** entry = environ; *entry; ++entry) {
        if (std::strncmp(*entry, "LC_ALL=", 7) != 0) out.emplace_back(*entry);
    }
    return out;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts) out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

pid_t start(const ProcessCall& call, const MemoryFile& in, const MemoryFile& out,
            const MemoryFile& err) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, in.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, err.descriptor(), STDERR_FILENO);
    std::vector<std::string> arguments{call.program.string()}, variables = environment();
    arguments.insert(arguments.end(), call.arguments.begin(), call.arguments.end());
    pid_t child = -1;
    const int status = ::posix_spawn(&child, call.program.c_str(), &files, nullptr,
                                     pointers(arguments).data(), pointers(variables).data());
    posix_spawn_file_actions_destroy(&files);
    if (status != 0) fail(call, std::string("cannot be started: ") + std::strerror(status));
    return child;
}

int wait_for(const ProcessCall& call, pid_t child) {
    const auto deadline = std::chrono::steady_clock::now() + call.timeout;
    auto nap = std::chrono::milliseconds(1);
    for (;;) {
        int status = 0;
        const pid_t ended = ::waitpid(child, &status, WNOHANG);
        if (ended == child) return status;
        if (ended < 0 && errno != EINTR) fail(call, "was lost while it ran");
        if (std::chrono::steady_clock::now() >= deadline) {
            ::kill(child, SIGKILL);
            while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
            }
            fail(call, "did not finish within " +
                           std::to_string(double(call.timeout.count()) / 1000).substr(0, 5) +
                           " seconds and was stopped");
        }
        std::this_thread::sleep_for(nap);
        nap = std::min(nap * 2, std::chrono::milliseconds(20));
    }
}

}  // namespace

std::filesystem::path find_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        std::filesystem::path file = std::filesystem::path(folder) / name;
        std::error_code ignored;
        if (!folder.empty() && std::filesystem::is_regular_file(file, ignored) &&
            ::access(file.c_str(), X_OK) == 0) {
            return file;
        }
    }
    return {};
}

ProcessResult run_process(const ProcessCall& call) {
    MemoryFile in(call), out(call), err(call);
    if (!in.fill(call.input)) fail(call, "cannot be run: no memory for its input");
    const int status = wait_for(call, start(call, in, out, err));
    if (WIFSIGNALED(status)) {
        fail(call, "was ended by signal " + std::to_string(WTERMSIG(status)));
    }
    return {WEXITSTATUS(status), out.all(), err.all()};
}

}  // namespace verdigris
